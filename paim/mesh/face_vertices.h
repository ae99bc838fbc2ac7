// Vertices that a face has. Only these can be seen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/bounds.h"
#include "paim/mesh/topology.h"

namespace paim {

// The vertices that a triangle has, ascending. The other vertices of the mesh, the isolated ones,
// count for nothing: not in errors, bounds, cameras or components (docs/geometry.md). Without any
// triangles there is nothing else than points, and all of them are returned.
std::vector<uint32_t> face_vertices(const Topology& topology);

// The vertices that face_vertices() leaves out, ascending.
std::vector<uint32_t> isolated_vertices(const Topology& topology);

// The faces whose vertices are all among these, in their order, with places in `vertices` as their
// vertices.
// vertices  different ones, below topology.num_vertices
Topology faces_among(const Topology& topology, std::span<const uint32_t> vertices);

// How many of the vertices, which are ascending, are below `end`.
size_t num_below(uint32_t end, std::span<const uint32_t> vertices);

// Bounds of these vertices.
// planes  [3][V] x, y and z
Bounds bounds_of_vertices(std::span<const float> planes, std::span<const uint32_t> vertices);

// Keeps the values of these vertices alone, in place.
// planes    [num_planes][V] becomes [num_planes][vertices.size()]
// vertices  ascending, below V
void keep_vertices(std::vector<float>& planes, uint32_t num_vertices,
                   std::span<const uint32_t> vertices);

}  // namespace paim
