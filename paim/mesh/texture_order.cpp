// The texture of a mesh whose vertices and faces are put in another order.
#include "paim/mesh/texture_order.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "paim/base/check.h"
#include "paim/mesh/lowest_corner.h"

namespace paim {

namespace {

// Triangles from their lowest corners on.
std::vector<Triangle> from_lowest(std::vector<Triangle> triangles) {
    for (Triangle& t : triangles) t = from_corner(t, lowest_corner(t));
    return triangles;
}

// The numbers of triangles, sorted by their vertices; equal ones stay in their order.
std::vector<uint32_t> sorted_numbers(const std::vector<Triangle>& triangles) {
    std::vector<uint32_t> numbers(triangles.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::stable_sort(numbers.begin(), numbers.end(),
                     [&](uint32_t a, uint32_t b) { return triangles[a] < triangles[b]; });
    return numbers;
}

// The number of each face in the old topology.
// faces  with vertices of the old topology
std::vector<uint32_t> old_faces(const Topology& old_topology, const std::vector<Triangle>& faces) {
    const std::vector<Triangle> before = from_lowest(old_topology.triangles);
    const std::vector<Triangle> now = from_lowest(faces);
    const std::vector<uint32_t> sorted_before = sorted_numbers(before);
    const std::vector<uint32_t> sorted_now = sorted_numbers(now);
    std::vector<uint32_t> old(faces.size());
    for (size_t i = 0; i < faces.size(); ++i) {
        PAIM_CHECK(before[sorted_before[i]] == now[sorted_now[i]]);
        old[sorted_now[i]] = sorted_before[i];
    }
    return old;
}

// Numbers the coordinates in the order of their use.
void renumber_coordinates(const Topology& topology, Texture& texture) {
    constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();
    std::vector<uint32_t> numbers(texture.coordinates.size(), kNone);
    std::vector<Vec2f> used;
    for (size_t f = 0; f < texture.corners.size(); ++f) {
        if (texture.image_of_face[f] == 0) continue;
        const size_t first = lowest_corner(topology.triangles[f]);
        for (size_t k = 0; k < 3; ++k) {
            uint32_t& corner = texture.corners[f][(first + k) % 3];
            uint32_t& number = numbers[corner];
            if (number == kNone) {
                number = static_cast<uint32_t>(used.size());
                used.push_back(texture.coordinates[corner]);
            }
            corner = number;
        }
    }
    texture.coordinates = std::move(used);
}

}  // namespace

Texture reordered(const Texture& texture, const Topology& old_topology, const Topology& topology,
                  std::span<const uint32_t> old_vertex) {
    if (texture.empty()) return {};
    const size_t num_faces = topology.triangles.size();
    PAIM_CHECK_EQ(texture.corners.size(), num_faces);
    PAIM_CHECK_EQ(old_topology.triangles.size(), num_faces);
    std::vector<Triangle> faces = topology.triangles;
    for (Triangle& t : faces) t = {old_vertex[t[0]], old_vertex[t[1]], old_vertex[t[2]]};
    const std::vector<uint32_t> old = old_faces(old_topology, faces);
    Texture result;
    result.images = texture.images;
    result.factors = texture.factors;
    result.coordinates = texture.coordinates;
    result.corners.resize(num_faces, Triangle{});
    result.image_of_face.resize(num_faces, 0);
    for (size_t f = 0; f < num_faces; ++f) {
        result.image_of_face[f] = texture.image_of_face[old[f]];
        if (result.image_of_face[f] == 0) continue;
        const size_t first_now = lowest_corner(faces[f]);
        const size_t first_before = lowest_corner(old_topology.triangles[old[f]]);
        for (size_t k = 0; k < 3; ++k) {
            result.corners[f][(first_now + k) % 3] =
                texture.corners[old[f]][(first_before + k) % 3];
        }
    }
    renumber_coordinates(topology, result);
    return result;
}

}  // namespace paim
