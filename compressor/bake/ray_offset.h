// How far shadow rays start off the surface.
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

constexpr double kOffsetOfEdge = 1e-4;

// Distance along the vertex normal at which the rays of each vertex start, scene units: 10⁻⁴ of the mean
// length of the edges round it, so that it scales with the mesh and is small against its detail, but
// never less than four roundings of its coordinates, below which the start would not move at all.
// positions [V]; returns [V]
std::vector<float> ray_offsets(const Topology& topology, std::span<const Vec3f> positions,
                               double of_edge = kOffsetOfEdge);

}  // namespace paim
