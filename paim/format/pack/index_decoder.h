// Decodes triangles: Zstandard, then meshoptimizer's index codec.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/topology.h"

namespace paim {

// Fills `out`. Returns false for bytes that are not an encoding of that many triangles. Indices are
// not checked: they may be of vertices that do not exist.
bool decode_triangles(std::span<const uint8_t> bytes, std::span<Triangle> out);

}  // namespace paim
