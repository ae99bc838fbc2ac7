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
    uint32_t cluster_components = std::numeric_limits<uint32_t>::max();  // of each vertex

    bool operator==(const DecodeLimits&) const = default;
};

}  // namespace paim
