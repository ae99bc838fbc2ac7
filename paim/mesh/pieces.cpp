// The connected pieces of a mesh.
#include "paim/mesh/pieces.h"

#include "paim/mesh/sets.h"

namespace paim {

Pieces connected_pieces(const Topology& topology) {
    Sets sets(topology.num_vertices);
    for (const Triangle& t : topology.triangles) {
        sets.join(t[0], t[1]);
        sets.join(t[0], t[2]);
    }
    Pieces pieces;
    pieces.of_vertex.resize(topology.num_vertices);
    for (uint32_t v = 0; v < topology.num_vertices; ++v) {
        const uint32_t root = sets.lowest(v);
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
