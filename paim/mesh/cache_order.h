// Vertices and triangles in an order in which neighbours are close together.
// Based on: Forsyth, Linear-Speed Vertex Cache Optimisation, 2006
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/root_motion.h"
#include "paim/mesh/topology.h"

namespace paim {

struct CacheOrder {
    std::vector<uint32_t> old_vertex;  // [V] number of each vertex in the old mesh
    Topology topology;                 // reordered; corners of a triangle may be rotated
};

// The order depends on the topology alone, so that it can be found again from the old mesh.
// Vertices without triangles come last, in their old order. Where the vertices from some number on
// share no triangle with those before, and neither do their triangles come before, this stays so.
CacheOrder cache_order(const Topology& topology);

// The new number of the first vertex whose old number is `first` or more; kAllVertices if there is
// none.
uint32_t new_number_of_first(uint32_t first, const std::vector<uint32_t>& old_vertex);

}  // namespace paim
