// Seams: where a surface is cut into patches whose vertices lie at the same places.
#include "paim/mesh/seams.h"

#include "paim/base/check.h"
#include "paim/mesh/face_edges.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/sets.h"

namespace paim {

namespace {

// Faces whose normals have a cosine below this lie back to back (0.8° apart).
constexpr double kBackToBack = -0.9999;

// Edges of one face, by vertices.
std::vector<FaceEdge> open_edges(const Topology& topology) {
    std::vector<FaceEdge> open;
    for_each_edge(face_edges(topology), {}, [&](std::span<const FaceEdge> edges) {
        if (edges.size() == 1) open.push_back(edges[0]);
    });
    return open;
}

}  // namespace

std::vector<uint32_t> find_seams(const Topology& topology, std::span<const uint32_t> places,
                                 std::span<const Vec3f> first_pose, double longest_edge) {
    if (places.empty()) return {};
    PAIM_CHECK_EQ(places.size(), topology.num_vertices);
    PAIM_CHECK_EQ(first_pose.size(), topology.num_vertices);
    const auto normal = [&](const FaceEdge& edge) {
        const Triangle& t = topology.triangles[edge.face];
        return face_normal(first_pose[t[0]], first_pose[t[1]], first_pose[t[2]]);
    };
    const auto has_outlier = [&](const FaceEdge& edge) {
        const Triangle& t = topology.triangles[edge.face];
        for (size_t i = 0; i < 3; ++i) {
            const Vec3d side =
                first_pose[t[i]].cast<double>() - first_pose[t[(i + 1) % 3]].cast<double>();
            if (side.norm() > longest_edge) return true;
        }
        return false;
    };
    const auto back_to_back = [&](const FaceEdge& a, const FaceEdge& b) {
        return normal(a).dot(normal(b)) < kBackToBack && !has_outlier(a) && !has_outlier(b);
    };
    Sets sets(topology.num_vertices);
    bool any = false;
    for_each_edge(open_edges(topology), places, [&](std::span<const FaceEdge> edges) {
        if (edges.size() != 2 || !run_opposite(edges[0], edges[1], places)) return;
        if (back_to_back(edges[0], edges[1])) return;
        sets.join(edges[0].vertices[0], edges[1].vertices[1]);
        sets.join(edges[0].vertices[1], edges[1].vertices[0]);
        any = true;
    });
    if (!any) return {};
    std::vector<uint32_t> seams(topology.num_vertices);
    for (uint32_t v = 0; v < seams.size(); ++v) seams[v] = sets.lowest(v);
    return seams;
}

}  // namespace paim
