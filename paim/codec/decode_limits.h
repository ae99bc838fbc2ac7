// Limits of how much of a file is used when it is played.
#pragma once

#include <cstdint>
#include <limits>

namespace paim {

// Numbers larger than those of the file mean all. At least one band is used.
struct DecodeLimits {
    uint32_t geometry_components = std::numeric_limits<uint32_t>::max();
    uint32_t transfer_components = std::numeric_limits<uint32_t>::max();
    uint32_t bands = std::numeric_limits<uint32_t>::max();
    // That a vertex sums up itself: of codecs whose vertices share what is rebuilt over the poses.
    uint32_t vertex_components = std::numeric_limits<uint32_t>::max();
    // The same of glossy transfer.
    uint32_t gloss_components = std::numeric_limits<uint32_t>::max();
    uint32_t gloss_vertex_components = std::numeric_limits<uint32_t>::max();

    bool operator==(const DecodeLimits&) const = default;
};

}  // namespace paim
