// The connected pieces of a mesh.
// Based on: Tarjan and van Leeuwen, Worst-Case Analysis of Set Union Algorithms, 1984 (path halving)
#include "paim/mesh/pieces.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace paim {

Pieces connected_pieces(const Topology& topology) {
    std::vector<uint32_t> parent(topology.num_vertices);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root_of = [&](uint32_t v) {
        while (parent[v] != v) {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        return v;
    };
    // Roots are the lowest vertices of their trees.
    const auto join = [&](uint32_t a, uint32_t b) {
        const uint32_t root_a = root_of(a), root_b = root_of(b);
        parent[std::max(root_a, root_b)] = std::min(root_a, root_b);
    };
    for (const Triangle& t : topology.triangles) {
        join(t[0], t[1]);
        join(t[0], t[2]);
    }
    Pieces pieces;
    pieces.of_vertex.resize(topology.num_vertices);
    for (uint32_t v = 0; v < topology.num_vertices; ++v) {
        const uint32_t root = root_of(v);
        if (root == v) {
            pieces.of_vertex[v] = pieces.count++;
            pieces.num_vertices.push_back(0);
        } else {
            pieces.of_vertex[v] = pieces.of_vertex[root];
        }
        ++pieces.num_vertices[pieces.of_vertex[v]];
    }
    return pieces;
}

}  // namespace paim
