// A part of a mesh without the vertices that lie far from its others, such as outliers in one pose.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/topology.h"

namespace paim {

// Draws in the vertices of a part that lie outside the sphere round its median point whose diameter
// is its size (mesh/body_size.h): to the mean of their neighbours inside the sphere, or, without
// such neighbours, to the nearest point of the sphere. So an outlier comes back to its part. A part
// that reaches that far is pressed into the sphere, and keeps the side that it faces.
// triangles  numbers of the part's triangles, at least one
// positions  [V] scene units, finite where a face has the vertex
// drawn_in   [V] positions; those of such vertices are set
// returns    whether there are any
bool draw_in_far_vertices(const Topology& topology, std::span<const uint32_t> triangles,
                          std::span<const Vec3f> positions, std::span<Vec3f> drawn_in);

}  // namespace paim
