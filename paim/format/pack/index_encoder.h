// Triangles as bytes: meshoptimizer's index codec under Zstandard.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Small where triangles share edges with those just before them (mesh/cache_order.h). Triangles keep
// their order but may be turned: (a, b, c) may come back as (b, c, a).
std::vector<uint8_t> encode_triangles(const Topology& topology);

}  // namespace paim
