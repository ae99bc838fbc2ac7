// How much memory it takes to encode to a target, where components are held in memory.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/memory/memory_plan.h"

namespace paim {

// What the memory of encode_to_target() depends on.
struct TargetSize {
    EncodeSize streamed;      // while rows are read
    uint32_t num_planes = 0;  // of the transfer, with the bands that are kept
    // Of the factors: what principal components leave of the poses.
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    bool clusters = true;  // codec cpca is tried
};

// What is in memory from the factors on to the end.
uint64_t target_held_bytes(const TargetSize& size);

// Peak memory of the process, an upper bound for this many threads: the least there must be.
uint64_t target_memory_bytes(const TargetSize& size);

// Error (unsupported) naming `what` and the memory that is needed, if it is more than limit_bytes; and
// what codec svd alone needs, where that is not.
void check_target_memory(const TargetSize& size, uint64_t limit_bytes, const std::string& what);

// The most runs of rows in flight, a power of two, while factors are read; the limit has been checked.
uint32_t choose_target_in_flight(const TargetSize& size, uint64_t limit_bytes);

}  // namespace paim
