// Strips between rings, splitting and relaxation.
#include "poses/ring_mesh.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim::poses {

namespace {

void add(uint32_t a, uint32_t b, uint32_t c, Facing facing, std::vector<Triangle>& triangles) {
    if (facing == Facing::inward) std::swap(b, c);
    triangles.push_back({a, b, c});
}

// An edge of a closed mesh with the two faces beside it; `from` < `to`.
struct Edge {
    uint32_t from, to;
    uint32_t face[2];
    double length;
};

std::vector<Edge> find_edges(const Topology& topology, const std::vector<Vec3d>& positions) {
    struct Side {
        uint32_t from, to, face;
    };
    std::vector<Side> sides;
    sides.reserve(3 * topology.triangles.size());
    for (uint32_t face = 0; face < topology.triangles.size(); ++face) {
        const Triangle& t = topology.triangles[face];
        for (size_t corner = 0; corner < 3; ++corner) {
            const auto [low, high] = std::minmax(t[corner], t[(corner + 1) % 3]);
            sides.push_back({low, high, face});
        }
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.from, a.to, a.face) < std::tie(b.from, b.to, b.face);
    });
    PAIM_CHECK_EQ(sides.size() % 2, size_t{0});
    std::vector<Edge> edges;
    edges.reserve(sides.size() / 2);
    for (size_t i = 0; i < sides.size(); i += 2) {
        PAIM_CHECK_EQ(sides[i].from, sides[i + 1].from);
        PAIM_CHECK_EQ(sides[i].to, sides[i + 1].to);
        edges.push_back({sides[i].from,
                         sides[i].to,
                         {sides[i].face, sides[i + 1].face},
                         (positions[sides[i].from] - positions[sides[i].to]).norm()});
    }
    return edges;
}

// Cuts a face in two at the new vertex on its edge.
void cut_face(uint32_t face, const Edge& edge, uint32_t middle, std::vector<Triangle>& triangles) {
    Triangle first = triangles[face], second = first;
    std::replace(first.begin(), first.end(), edge.to, middle);
    std::replace(second.begin(), second.end(), edge.from, middle);
    triangles[face] = first;
    triangles.push_back(second);
}

}  // namespace

void stitch_rings(const Ring& outer, const Ring& inner, Facing facing,
                  std::vector<Triangle>& triangles) {
    const size_t size = inner.size();
    if (outer.size() == size) {
        for (size_t j = 0; j < size; ++j) {
            const size_t next = (j + 1) % size;
            add(outer[j], outer[next], inner[j], facing, triangles);
            add(outer[next], inner[next], inner[j], facing, triangles);
        }
        return;
    }
    PAIM_CHECK_EQ(outer.size(), 2 * size);
    for (size_t j = 0; j < size; ++j) {
        const size_t next = (j + 1) % size;
        add(outer[2 * j], outer[2 * j + 1], inner[j], facing, triangles);
        add(outer[2 * j + 1], inner[next], inner[j], facing, triangles);
        add(outer[2 * j + 1], outer[2 * next], inner[next], facing, triangles);
    }
}

void close_ring(const Ring& ring, uint32_t pole, Facing facing, std::vector<Triangle>& triangles) {
    for (size_t j = 0; j < ring.size(); ++j) {
        add(ring[j], ring[(j + 1) % ring.size()], pole, facing, triangles);
    }
}

void split_longest_edges(uint32_t count, const std::function<double(const Vec3d&)>& fineness,
                         Topology& topology, std::vector<Vec3d>& positions) {
    std::vector<Edge> edges = find_edges(topology, positions);
    for (Edge& edge : edges) {
        edge.length *= fineness(0.5 * (positions[edge.from] + positions[edge.to]));
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        if (a.length != b.length) return a.length > b.length;
        return std::tie(a.from, a.to) < std::tie(b.from, b.to);
    });
    std::vector<bool> used(topology.triangles.size(), false);
    for (const Edge& edge : edges) {
        if (count == 0) break;
        if (used[edge.face[0]] || used[edge.face[1]]) continue;
        used[edge.face[0]] = used[edge.face[1]] = true;
        const uint32_t middle = topology.num_vertices++;
        positions.push_back(0.5 * (positions[edge.from] + positions[edge.to]));
        for (const uint32_t face : edge.face) cut_face(face, edge, middle, topology.triangles);
        --count;
    }
    if (count > 0) throw_unsupported("{} more vertices than a mesh of this size can take", count);
}

void relax(const Topology& topology, int count, const std::function<Vec3d(const Vec3d&)>& project,
           std::vector<Vec3d>& positions) {
    // Each neighbour lies on two faces with its vertex, so it counts twice: the average is the
    // same.
    std::vector<uint32_t> num_neighbours(topology.num_vertices, 0);
    for (const Triangle& t : topology.triangles) {
        for (const uint32_t v : t) num_neighbours[v] += 2;
    }
    std::vector<Vec3d> sums(topology.num_vertices);
    for (int i = 0; i < count; ++i) {
        std::fill(sums.begin(), sums.end(), Vec3d::Zero());
        for (const Triangle& t : topology.triangles) {
            sums[t[0]] += positions[t[1]] + positions[t[2]];
            sums[t[1]] += positions[t[2]] + positions[t[0]];
            sums[t[2]] += positions[t[0]] + positions[t[1]];
        }
        parallel_for(positions.size(), 1024, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; ++v) {
                positions[v] = project(0.5 * positions[v] + 0.5 * sums[v] / num_neighbours[v]);
            }
        });
    }
}

}  // namespace paim::poses
