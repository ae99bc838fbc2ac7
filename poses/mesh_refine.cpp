// Splitting, flipping and relaxation of closed meshes.
#include "poses/mesh_refine.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim::poses {

namespace {

// An edge of a closed mesh with its two faces; `from` < `to`.
struct Edge {
    uint32_t from, to;
    uint32_t face[2];
    double length;
};

std::vector<Edge> find_edges(const Topology& topology, std::span<const Vec3d> positions) {
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

uint32_t corner_opposite(const Triangle& t, const Edge& edge) {
    return *std::find_if(t.begin(), t.end(),
                         [&](uint32_t v) { return v != edge.from && v != edge.to; });
}

struct Face {
    Vec3d area_normal;
    double quality;  // area over squared sides, 1 for an equilateral triangle
};

Face face(const Triangle& t, std::span<const Vec3d> positions) {
    const Vec3d &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
    const Vec3d normal = 0.5 * (b - a).cross(c - a);
    const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return {normal, 4.0 * std::sqrt(3.0) * normal.norm() / sides};
}

}  // namespace

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

void flip_edges(int count, std::span<const Vec3d> positions, Topology& topology) {
    for (int i = 0; i < count; ++i) {
        const std::vector<Edge> edges = find_edges(topology, positions);
        std::set<std::pair<uint32_t, uint32_t>> present;
        for (const Edge& edge : edges) present.insert({edge.from, edge.to});
        std::vector<bool> used(topology.triangles.size(), false);
        for (const Edge& edge : edges) {
            Triangle &left = topology.triangles[edge.face[0]],
                     &right = topology.triangles[edge.face[1]];
            if (used[edge.face[0]] || used[edge.face[1]]) continue;
            const uint32_t c = corner_opposite(left, edge), d = corner_opposite(right, edge);
            const std::pair<uint32_t, uint32_t> turned = std::minmax(c, d);
            if (present.contains(turned)) continue;
            Triangle new_left = left, new_right = right;  // left keeps `from`, right keeps `to`
            std::replace(new_left.begin(), new_left.end(), edge.to, d);
            std::replace(new_right.begin(), new_right.end(), edge.from, c);
            const Face old_faces[] = {face(left, positions), face(right, positions)};
            const Face new_faces[] = {face(new_left, positions), face(new_right, positions)};
            const double before = std::min(old_faces[0].quality, old_faces[1].quality);
            const double after = std::min(new_faces[0].quality, new_faces[1].quality);
            const Vec3d normal = (old_faces[0].area_normal + old_faces[1].area_normal).normalized();
            constexpr double kMinCosine = 0.8;
            if (after < 1.1 * before ||
                new_faces[0].area_normal.normalized().dot(normal) < kMinCosine ||
                new_faces[1].area_normal.normalized().dot(normal) < kMinCosine) {
                continue;
            }
            left = new_left;
            right = new_right;
            used[edge.face[0]] = used[edge.face[1]] = true;
            present.erase({edge.from, edge.to});
            present.insert(turned);
        }
    }
}

void relax(const Topology& topology, int count, const std::function<Vec3d(const Vec3d&)>& project,
           std::vector<Vec3d>& positions) {
    // Each neighbour is on two faces with its vertex, so it counts twice, and the average is the
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
