// Vertices and triangles in an order in which neighbours are close together.
// Based on: Forsyth, Linear-Speed Vertex Cache Optimisation, 2006
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

struct CacheOrder {
    std::vector<uint32_t> old_vertex;  // [V] which vertex of the old mesh each one is
    Topology topology;                 // triangles reordered, and perhaps turned, not mirrored
};

// Depends on the topology alone, so that the order can be found again from the old mesh. Vertices without
// triangles come last, in their old order.
CacheOrder cache_order(const Topology& topology);

}  // namespace paim
