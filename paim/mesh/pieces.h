// The connected pieces of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Vertices are in the same piece if a path of edges connects them.
struct Pieces {
    uint32_t count = 0;
    std::vector<uint32_t> of_vertex;  // [V] numbers of pieces, in the order of their first vertices
    std::vector<uint32_t> num_vertices;  // [count]
};

Pieces connected_pieces(const Topology& topology);

}  // namespace paim
