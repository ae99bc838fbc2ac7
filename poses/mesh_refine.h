// Refinement of closed meshes on a surface: split, flip, relax.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::poses {

// Adds `count` vertices at the middles of the longest edges, no two of them on one face, so that a
// closed mesh gets exactly the size asked for. An edge's length is multiplied by the fineness at
// its middle. Throws Error(unsupported) if there are too few edges.
void split_longest_edges(uint32_t count, const std::function<double(const Vec3d&)>& fineness,
                         Topology& topology, std::vector<Vec3d>& positions);

// Turns edges within their two faces, where that makes the worse face better by a tenth
// and leaves the surface as it is but for a small angle. Goes over all edges `count` times.
void flip_edges(int count, std::span<const Vec3d> positions, Topology& topology);

// Moves every vertex half way to the average of its neighbours and back onto the surface, `count`
// times: evens out the triangles of a closed mesh.
void relax(const Topology& topology, int count, const std::function<Vec3d(const Vec3d&)>& project,
           std::vector<Vec3d>& positions);

}  // namespace paim::poses
