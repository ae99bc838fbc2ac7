// The material of each vertex, from the materials of its faces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A vertex has the material whose faces have the largest sum of angles at it. Sums that differ by
// less than 10⁻⁶ rad, the rounding of coordinates, are equal; of materials with equal sums the one
// of the first face counts. A vertex without a face has material 0.
// positions  [V]
// of_face    [F] numbers of materials
// returns    [V], or [1] if all faces have the same material
std::vector<uint16_t> materials_of_vertices(const Topology& topology,
                                            std::span<const Vec3f> positions,
                                            std::span<const uint16_t> of_face);

}  // namespace paim
