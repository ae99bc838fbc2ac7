// Vertices that a face has.
#include "paim/mesh/face_vertices.h"

#include <algorithm>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

// [V] Whether a triangle has the vertex.
std::vector<bool> has_face(const Topology& topology) {
    std::vector<bool> has(topology.num_vertices, topology.triangles.empty());
    for (const Triangle& triangle : topology.triangles) {
        for (const uint32_t v : triangle) has[v] = true;
    }
    return has;
}

std::vector<uint32_t> vertices_where(const std::vector<bool>& has, bool value) {
    std::vector<uint32_t> vertices;
    for (size_t v = 0; v < has.size(); ++v) {
        if (has[v] == value) vertices.push_back(static_cast<uint32_t>(v));
    }
    return vertices;
}

}  // namespace

std::vector<uint32_t> face_vertices(const Topology& topology) {
    return vertices_where(has_face(topology), true);
}

std::vector<uint32_t> isolated_vertices(const Topology& topology) {
    return vertices_where(has_face(topology), false);
}

Topology faces_among(const Topology& topology, std::span<const uint32_t> vertices) {
    constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> places(topology.num_vertices, kNone);
    for (uint32_t j = 0; j < vertices.size(); ++j) places[vertices[j]] = j;
    Topology among;
    among.num_vertices = static_cast<uint32_t>(vertices.size());
    for (const Triangle& face : topology.triangles) {
        const Triangle placed{places[face[0]], places[face[1]], places[face[2]]};
        if (std::find(placed.begin(), placed.end(), kNone) == placed.end()) {
            among.triangles.push_back(placed);
        }
    }
    return among;
}

Bounds bounds_of_vertices(std::span<const float> planes, std::span<const uint32_t> vertices) {
    PAIM_CHECK_EQ(planes.size() % 3, size_t{0});
    const size_t count = planes.size() / 3;
    Bounds bounds;
    for (const uint32_t v : vertices) {
        PAIM_CHECK_LT(v, count);
        bounds.extend(Vec3f(planes[v], planes[count + v], planes[2 * count + v]));
    }
    return bounds;
}

void keep_vertices(std::vector<float>& planes, uint32_t num_vertices,
                   std::span<const uint32_t> vertices) {
    if (vertices.size() == num_vertices) return;
    PAIM_CHECK(num_vertices > 0 && planes.size() % num_vertices == 0);
    // No value is written before it has been read, because vertices ascend.
    size_t kept = 0;
    for (size_t first = 0; first < planes.size(); first += num_vertices) {
        for (const uint32_t v : vertices) planes[kept++] = planes[first + v];
    }
    planes.resize(kept);
}

size_t num_below(uint32_t end, std::span<const uint32_t> vertices) {
    return static_cast<size_t>(std::lower_bound(vertices.begin(), vertices.end(), end) -
                               vertices.begin());
}

}  // namespace paim
