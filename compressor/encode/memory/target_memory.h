// How much memory it takes to encode to a target, which holds the components in memory.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/memory/memory_plan.h"

namespace paim {

// What the memory of encode_to_target() depends on.
struct TargetSize {
    EncodeSize streamed;      // of the bake, while its rows are read
    uint32_t num_planes = 0;  // of the transfer, with the bands that are kept
    // Of the factors that are held.
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    bool clusters = true;  // codec cpca is tried
};

// Memory that is held from the reading of the factors to the end.
uint64_t target_held_bytes(const TargetSize& size);

// Peak memory of the process, an upper bound for this many threads: the least there must be.
uint64_t target_memory_bytes(const TargetSize& size);

// Error (unsupported), naming `what` and the memory that is needed, if that is more than
// limit_bytes. If codec svd alone needs no more than the limit, the error says so.
void check_target_memory(const TargetSize& size, uint64_t limit_bytes, const std::string& what);

// The largest number of runs of rows in flight, a power of two, while factors are read. The limit
// has been checked.
uint32_t choose_target_in_flight(const TargetSize& size, uint64_t limit_bytes);

}  // namespace paim
