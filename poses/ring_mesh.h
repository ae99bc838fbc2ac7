// Triangle strips between closed rings of vertices, and the refinement of a closed mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::poses {

using Ring = std::vector<uint32_t>;  // vertices in cyclic order

enum class Facing { outward, inward };

// Joins two rings that run the same way round; the inner one has as many vertices, or half as many
// (then inner[j] lies beside outer[2j]). Faces are counter-clockwise seen from the side on which
// the rings run counter-clockwise about the inner one (outward), or from the other (inward).
void stitch_rings(const Ring& outer, const Ring& inner, Facing facing,
                  std::vector<Triangle>& triangles);

// Closes a ring with a fan about one vertex.
void close_ring(const Ring& ring, uint32_t pole, Facing facing, std::vector<Triangle>& triangles);

// Adds `count` vertices at the middles of the longest edges, no two of them on one face, so that a
// closed mesh gets exactly the size asked for. An edge's length is multiplied by the fineness at
// its middle. Throws Error(unsupported) if there are too few edges.
void split_longest_edges(uint32_t count, const std::function<double(const Vec3d&)>& fineness,
                         Topology& topology, std::vector<Vec3d>& positions);

// Moves every vertex half way to the average of its neighbours and back onto the surface, `count`
// times: evens out the triangles of a closed mesh.
void relax(const Topology& topology, int count, const std::function<Vec3d(const Vec3d&)>& project,
           std::vector<Vec3d>& positions);

}  // namespace paim::poses
