// A part of a mesh without the vertices that lie far from its others.
#include "paim/mesh/far_vertices.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/mesh/body_size.h"

namespace paim {

namespace {

struct Sphere {
    Vec3d centre;
    double radius = 0.0;

    bool holds(const Vec3d& point) const { return (point - centre).stableNorm() <= radius; }
    // To a point outside.
    Vec3d nearest(const Vec3d& point) const {
        return centre + radius / (point - centre).stableNorm() * (point - centre);
    }
};

// Of the triangles, ascending.
std::vector<uint32_t> vertices_of(const Topology& topology, std::span<const uint32_t> triangles) {
    std::vector<uint32_t> vertices;
    vertices.reserve(3 * triangles.size());
    for (const uint32_t f : triangles) {
        vertices.insert(vertices.end(), topology.triangles[f].begin(), topology.triangles[f].end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
}

// Of neighbours inside the sphere.
struct Sum {
    Vec3d positions = Vec3d::Zero();
    double count = 0.0;
};

}  // namespace

bool draw_in_far_vertices(const Topology& topology, std::span<const uint32_t> triangles,
                          std::span<const Vec3f> positions, std::span<Vec3f> drawn_in) {
    PAIM_CHECK(!triangles.empty());
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    PAIM_CHECK_EQ(drawn_in.size(), positions.size());
    const std::vector<uint32_t> vertices = vertices_of(topology, triangles);
    std::vector<Vec3d> points;
    for (const uint32_t v : vertices) points.push_back(positions[v].cast<double>());
    const Sphere sphere{median_point(points), 0.5 * size_of(points)};
    std::vector<uint32_t> far;
    for (size_t j = 0; j < vertices.size(); ++j) {
        if (!sphere.holds(points[j])) far.push_back(vertices[j]);
    }
    if (far.empty()) return false;
    std::vector<Sum> sums(far.size());
    for (const uint32_t f : triangles) {
        for (const uint32_t v : topology.triangles[f]) {
            const auto found = std::lower_bound(far.begin(), far.end(), v);
            if (found == far.end() || *found != v) continue;
            Sum& sum = sums[static_cast<size_t>(found - far.begin())];
            for (const uint32_t other : topology.triangles[f]) {
                if (!sphere.holds(positions[other].cast<double>())) continue;
                sum.positions += positions[other].cast<double>();
                sum.count += 1.0;
            }
        }
    }
    for (size_t j = 0; j < far.size(); ++j) {
        const Vec3d place = sums[j].count > 0.0 ? Vec3d(sums[j].positions / sums[j].count)
                                                : sphere.nearest(positions[far[j]].cast<double>());
        drawn_in[far[j]] = place.cast<float>();
    }
    return true;
}

}  // namespace paim
