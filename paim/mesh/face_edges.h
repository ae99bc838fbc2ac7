// Edges of the faces of a mesh, grouped by their ends.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// An edge in the direction in which its face runs.
struct FaceEdge {
    std::array<uint32_t, 2> vertices;
    uint32_t face;
};

// Three of each face; none of faces that name a vertex twice.
inline std::vector<FaceEdge> face_edges(const Topology& topology) {
    std::vector<FaceEdge> edges;
    edges.reserve(3 * topology.triangles.size());
    for (uint32_t f = 0; f < topology.triangles.size(); ++f) {
        const Triangle& t = topology.triangles[f];
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        for (size_t i = 0; i < 3; ++i) edges.push_back({{t[i], t[(i + 1) % 3]}, f});
    }
    return edges;
}

// Calls body with the edges of the same two ends, by ascending face. Ends are vertices, or places
// (mesh/places.h) if they are given; edges whose ends are one place are left out.
template <typename Body>
void for_each_edge(std::vector<FaceEdge> edges, std::span<const uint32_t> places,
                   const Body& body) {
    const auto ends = [&](const FaceEdge& edge) {
        const auto [a, b] = edge.vertices;
        return places.empty() ? std::minmax({a, b}) : std::minmax({places[a], places[b]});
    };
    std::erase_if(edges,
                  [&](const FaceEdge& edge) { return ends(edge).first == ends(edge).second; });
    std::sort(edges.begin(), edges.end(), [&](const FaceEdge& a, const FaceEdge& b) {
        return std::pair(ends(a), a.face) < std::pair(ends(b), b.face);
    });
    for (size_t i = 0, end = 0; i < edges.size(); i = end) {
        while (end < edges.size() && ends(edges[end]) == ends(edges[i])) ++end;
        body(std::span<const FaceEdge>(edges).subspan(i, end - i));
    }
}

// Whether two edges with the same ends (by place) run in opposite directions, as those of
// neighbours that face the same side do.
inline bool run_opposite(const FaceEdge& a, const FaceEdge& b, std::span<const uint32_t> places) {
    const auto place = [&](uint32_t v) { return places.empty() ? v : places[v]; };
    return place(a.vertices[0]) == place(b.vertices[1]);
}

}  // namespace paim
