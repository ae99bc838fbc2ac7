// Counts odd properties of a mesh.
#include "paim/mesh/mesh_report.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/places.h"

namespace paim {

namespace {

// A face with its vertices in ascending order.
struct SortedFace {
    Triangle vertices;
    uint32_t index;  // of the face
    bool reversed;   // sorting took an odd number of swaps

    explicit SortedFace(const Triangle& face, uint32_t face_index)
        : vertices(face), index(face_index), reversed(false) {
        for (const auto& [a, b] : {std::pair<size_t, size_t>{0, 1}, {1, 2}, {0, 1}}) {
            if (vertices[a] <= vertices[b]) continue;
            std::swap(vertices[a], vertices[b]);
            reversed = !reversed;
        }
    }
    bool repeats_vertex() const { return vertices[0] == vertices[1] || vertices[1] == vertices[2]; }
    bool operator<(const SortedFace& other) const {
        return std::tie(vertices, index) < std::tie(other.vertices, other.index);
    }
};

enum class Copy : uint8_t { none, same_side, other_side };

// Whether an earlier face has the same three vertices, [F]. Faces that name a vertex twice are
// never copies.
std::vector<Copy> find_copies(std::span<const Triangle> faces) {
    std::vector<SortedFace> sorted;
    sorted.reserve(faces.size());
    for (size_t f = 0; f < faces.size(); ++f) {
        const SortedFace face(faces[f], static_cast<uint32_t>(f));
        if (!face.repeats_vertex()) sorted.push_back(face);
    }
    std::sort(sorted.begin(), sorted.end());
    std::vector<Copy> copies(faces.size(), Copy::none);
    const SortedFace* first = nullptr;
    for (const SortedFace& face : sorted) {
        if (first == nullptr || first->vertices != face.vertices) {
            first = &face;
        } else {
            copies[face.index] =
                face.reversed == first->reversed ? Copy::same_side : Copy::other_side;
        }
    }
    return copies;
}

void count_edges(std::span<const Triangle> faces, const std::vector<Copy>& copies,
                 TopologyReport& report) {
    // Lower and higher vertex number, and whether the face runs from the higher to the lower.
    using Edge = std::tuple<uint32_t, uint32_t, bool>;
    std::vector<Edge> edges;
    edges.reserve(3 * faces.size());
    for (size_t f = 0; f < faces.size(); ++f) {
        if (copies[f] != Copy::none || SortedFace(faces[f], 0).repeats_vertex()) continue;
        for (size_t corner = 0; corner < 3; ++corner) {
            const uint32_t a = faces[f][corner];
            const uint32_t b = faces[f][(corner + 1) % 3];
            edges.emplace_back(std::min(a, b), std::max(a, b), a > b);
        }
    }
    std::sort(edges.begin(), edges.end());
    for (size_t i = 0, end = 0; i < edges.size(); i = end) {
        const auto ends = [&](size_t e) {
            return std::pair(std::get<0>(edges[e]), std::get<1>(edges[e]));
        };
        while (end < edges.size() && ends(end) == ends(i)) ++end;
        const size_t num_faces = end - i;
        if (num_faces == 1) ++report.boundary_edges;
        if (num_faces == 2 && edges[i] == edges[i + 1]) ++report.flipped_edges;
        if (num_faces > 2) ++report.non_manifold_edges;
    }
}

}  // namespace

TopologyReport report_topology(const Topology& topology) {
    TopologyReport report;
    std::vector<bool> used(topology.num_vertices, false);
    for (const Triangle& face : topology.triangles) {
        for (const uint32_t v : face) used[v] = true;
    }
    const std::vector<Copy> copies = find_copies(topology.triangles);
    const auto count = [](const auto& list, auto value) {
        return static_cast<uint64_t>(std::count(list.begin(), list.end(), value));
    };
    report.isolated_vertices = count(used, false);
    report.duplicate_faces = count(copies, Copy::same_side);
    report.back_faces = count(copies, Copy::other_side);
    count_edges(topology.triangles, copies, report);
    return report;
}

PoseReport report_pose(const Topology& topology, std::span<const Vec3f> positions) {
    PAIM_CHECK_EQ(positions.size(), topology.num_vertices);
    const std::vector<uint32_t> first = first_at_position(positions);
    PoseReport report;
    std::vector<Triangle> faces;   // faces with area
    std::vector<Triangle> places;  // the same faces, by the first vertex at each position
    for (const Triangle& face : topology.triangles) {
        if (face_normal(positions[face[0]], positions[face[1]], positions[face[2]]).isZero(0.0)) {
            ++report.zero_area_faces;
        } else if (!first.empty()) {
            faces.push_back(face);
            places.push_back({first[face[0]], first[face[1]], first[face[2]]});
        }
    }
    if (first.empty()) return report;
    const std::vector<Copy> same_vertices = find_copies(faces);
    const std::vector<Copy> same_places = find_copies(places);
    for (size_t f = 0; f < faces.size(); ++f) {
        if (same_places[f] != Copy::none && same_vertices[f] == Copy::none) {
            ++report.coincident_faces;
        }
    }
    return report;
}

Topology without_duplicate_faces(const Topology& topology) {
    const std::vector<Copy> copies = find_copies(topology.triangles);
    Topology distinct{topology.num_vertices, {}};
    for (size_t f = 0; f < copies.size(); ++f) {
        if (copies[f] == Copy::none) distinct.triangles.push_back(topology.triangles[f]);
    }
    return distinct;
}

}  // namespace paim
