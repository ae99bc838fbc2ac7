// What a test may ask of a triangle mesh: is it closed, oriented, in one piece, and well shaped?
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Half-edges from a to b, and how often each occurs.
inline std::map<std::pair<uint32_t, uint32_t>, int> half_edges(const Topology& topology) {
    std::map<std::pair<uint32_t, uint32_t>, int> count;
    for (const Triangle& t : topology.triangles) {
        for (size_t i = 0; i < 3; ++i) ++count[{t[i], t[(i + 1) % 3]}];
    }
    return count;
}

// Edges that do not have exactly two faces running along them in opposite directions.
inline int count_bad_edges(const Topology& topology) {
    const auto edges = half_edges(topology);
    return static_cast<int>(std::count_if(edges.begin(), edges.end(), [&](const auto& entry) {
        const auto opposite = edges.find({entry.first.second, entry.first.first});
        return entry.second != 1 || opposite == edges.end();
    }));
}

// V − E + F of a closed mesh: 2 for each piece without handles.
inline int euler_characteristic(const Topology& topology) {
    const auto num_edges = static_cast<int>(half_edges(topology).size() / 2);
    return static_cast<int>(topology.num_vertices) - num_edges +
           static_cast<int>(topology.triangles.size());
}

// Pieces that hang together by faces; a vertex without faces is a piece.
inline uint32_t count_components(const Topology& topology) {
    std::vector<uint32_t> parent(topology.num_vertices);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](uint32_t v) {
        while (parent[v] != v) v = parent[v] = parent[parent[v]];
        return v;
    };
    for (const Triangle& t : topology.triangles) {
        parent[root(t[0])] = root(t[1]);
        parent[root(t[1])] = root(t[2]);
    }
    uint32_t count = 0;
    for (uint32_t v = 0; v < topology.num_vertices; ++v) count += root(v) == v;
    return count;
}

// Volume inside a closed mesh, positive where faces are counter-clockwise from outside.
inline double signed_volume(const Topology& topology, std::span<const Vec3f> positions) {
    double volume = 0.0;
    for (const Triangle& t : topology.triangles) {
        const Vec3d a = positions[t[0]].cast<double>(), b = positions[t[1]].cast<double>(),
                    c = positions[t[2]].cast<double>();
        volume += a.dot(b.cross(c)) / 6.0;
    }
    return volume;
}

// Area over the sum of squared sides, 1 for an equilateral triangle, 0 for a needle: the worst
// face.
inline double worst_quality(const Topology& topology, std::span<const Vec3f> positions) {
    double worst = std::numeric_limits<double>::infinity();
    for (const Triangle& t : topology.triangles) {
        const Vec3d a = positions[t[0]].cast<double>(), b = positions[t[1]].cast<double>(),
                    c = positions[t[2]].cast<double>();
        const double area = 0.5 * (b - a).cross(c - a).norm();
        const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
        worst = std::min(worst, 4.0 * std::sqrt(3.0) * area / sides);
    }
    return worst;
}

}  // namespace paim
