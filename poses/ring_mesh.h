// Triangle strips between closed rings of vertices.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim::poses {

using Ring = std::vector<uint32_t>;  // vertices in cyclic order

enum class Facing { outward, inward };

// Joins two rings that run the same way round; the inner one has as many vertices, or half as many
// (then inner[j] lies next to outer[2j]). Faces are counter-clockwise seen from the side on which
// the rings run counter-clockwise about the inner one (outward), or from the other (inward).
void stitch_rings(const Ring& outer, const Ring& inner, Facing facing,
                  std::vector<Triangle>& triangles);

// Closes a ring with a fan about one vertex.
void close_ring(const Ring& ring, uint32_t pole, Facing facing, std::vector<Triangle>& triangles);

}  // namespace paim::poses
