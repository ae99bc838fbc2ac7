// Triangles from bytes: meshoptimizer's index codec under Zstandard.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/topology.h"

namespace paim {

// Fills `out`; false for bytes that are not an encoding of that many triangles. What comes back may
// name vertices that do not exist.
bool decode_triangles(std::span<const uint8_t> bytes, std::span<Triangle> out);

}  // namespace paim
