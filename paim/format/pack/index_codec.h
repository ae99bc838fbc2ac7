// Triangles as bytes: meshoptimizer's index codec under Zstandard.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Small where triangles share edges with those just before them (mesh/cache_order.h). Triangles keep
// their order but may be turned: (a, b, c) may come back as (b, c, a).
std::vector<uint8_t> encode_triangles(const Topology& topology);

// Fills `out`; false for bytes that are not an encoding of that many triangles. What comes back may
// name vertices that do not exist.
bool decode_triangles(std::span<const uint8_t> bytes, std::span<Triangle> out);

}  // namespace paim
