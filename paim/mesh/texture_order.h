// The texture of a mesh whose vertices and faces are put in another order.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/texture.h"
#include "paim/mesh/topology.h"

namespace paim {

// Corners and images follow their faces. Of faces with the same vertices on the same side, the
// first of the old order is the first of the new one. Coordinates are numbered in the order in
// which the new faces use them, each from its lowest corner on, so that neighbours are close
// together.
// texture     of the old topology
// topology    the same faces in any order, with corners in any rotation
// old_vertex  [V] the number of each vertex in the old topology
Texture reordered(const Texture& texture, const Topology& old_topology, const Topology& topology,
                  std::span<const uint32_t> old_vertex);

}  // namespace paim
