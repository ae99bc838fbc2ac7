// Refinement of closed meshes on a surface: split, flip, relax.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::poses {

// Adds exactly `count` vertices to a closed mesh, at the middles of the longest edges, no two of
// them on one face. For the comparison an edge's length is multiplied by the fineness at
// its middle. Throws Error(unsupported) if there are too few edges.
void split_longest_edges(uint32_t count, const std::function<double(const Vec3d&)>& fineness,
                         Topology& topology, std::vector<Vec3d>& positions);

// Flips edges within their two faces if that improves the quality of the worse face by a tenth and
// changes the surface by a small angle only. Goes over all edges `count` times.
void flip_edges(int count, std::span<const Vec3d> positions, Topology& topology);

// Makes the triangles of a closed mesh more even: moves each vertex half way to the average of its
// neighbours and back onto the surface, `count` times.
void relax(const Topology& topology, int count, const std::function<Vec3d(const Vec3d&)>& project,
           std::vector<Vec3d>& positions);

}  // namespace paim::poses
