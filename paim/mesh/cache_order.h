// Vertices and triangles in an order in which neighbours are close together.
// Based on: Forsyth, Linear-Speed Vertex Cache Optimisation, 2006
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

struct CacheOrder {
    std::vector<uint32_t> old_vertex;  // [V] number of each vertex in the old mesh
    Topology topology;                 // reordered; corners of a triangle may be rotated
};

// The order depends on the topology alone, so that it can be found again from the old mesh.
// Vertices without triangles come last, in their old order.
CacheOrder cache_order(const Topology& topology);

}  // namespace paim
