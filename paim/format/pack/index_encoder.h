// Encodes triangles: meshoptimizer's index codec, then Zstandard.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// The result is small if triangles share edges with those just before them (mesh/cache_order.h).
// Decoded triangles have the same order, but their corners may be rotated: (a, b, c) may become (b,
// c, a).
std::vector<uint8_t> encode_triangles(const Topology& topology);

}  // namespace paim
