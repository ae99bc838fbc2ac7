// How much memory it takes to encode to a target, which holds the components in memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compressor/encode/memory/memory_plan.h"

namespace paim {

struct TargetSize;

// What the search for codings of one codec takes in addition to the search for any codec. Upper
// bounds for the threads of the size.
struct CodecMemory {
    uint64_t num_points = 0;       // of the codec's matrix; 0 if its points are the vertices
    uint64_t num_points_each = 0;  // of each group (codec/point_groups.h)
    uint64_t kept_bytes = 0;       // that stay from one target to the next
    uint64_t preparing_bytes = 0;  // of scratch, before a coding is made
    uint64_t coding_bytes = 0;     // that the codec's best coding holds until it is written
};

// A codec that a search may try.
struct SearchedCodec {
    std::string_view name;
    CodecMemory (*memory)(const TargetSize& size);
};

// What the memory of encode_to_target() depends on.
struct TargetSize {
    EncodeSize streamed;      // of the bake, while its rows are read
    uint32_t num_planes = 0;  // of the transfer, with the bands that are kept
    // Of the factors that are held.
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    std::vector<SearchedCodec> codecs = {};  // that are tried, in this order
};

// Memory that is held from the reading of the factors to the end.
uint64_t target_held_bytes(const TargetSize& size);

// Peak memory of the process, an upper bound for this many threads: the least there must be. 2^62
// where sizes are so large that their bytes cannot be added up.
uint64_t target_memory_bytes(const TargetSize& size);

// Error (unsupported), naming `what` and the memory that is needed, if that is more than
// limit_bytes. If one of these codecs alone needs no more than the limit, the error names the one
// that needs the least.
void check_target_memory(const TargetSize& size, const std::vector<SearchedCodec>& codecs,
                         uint64_t limit_bytes, const std::string& what);

// The largest number of runs of rows in flight, a power of two, while factors are read. The limit
// has been checked.
uint32_t choose_target_in_flight(const TargetSize& size, uint64_t limit_bytes);

}  // namespace paim
