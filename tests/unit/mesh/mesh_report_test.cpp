// Odd meshes: each kind counted by hand, and a closed mesh that has none of them.
#include "paim/mesh/mesh_report.h"

#include <gtest/gtest.h>

#include "paim/mesh/pose_set.h"

namespace paim {
namespace {

const Topology kTetrahedron{4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
const std::vector<Vec3f> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

// All counts, in the order of the declaration.
using Counts = std::array<uint64_t, 6>;

Counts counts_of(const Topology& topology) {
    const TopologyReport report = report_topology(topology);
    return {report.isolated_vertices, report.duplicate_faces, report.back_faces,
            report.boundary_edges,    report.flipped_edges,   report.non_manifold_edges};
}

TEST(MeshReport, FindsNothingOddInAClosedMesh) {
    EXPECT_EQ(counts_of(kTetrahedron), (Counts{}));
    const PoseReport pose = report_pose(kTetrahedron, kCorners);
    EXPECT_EQ(pose.zero_area_faces, 0u);
    EXPECT_EQ(pose.coincident_faces, 0u);
}

TEST(MeshReport, CountsOneTriangleAndIsolatedVertices) {
    EXPECT_EQ(counts_of({3, {{0, 1, 2}}}), (Counts{0, 0, 0, 3, 0, 0}));
    EXPECT_EQ(counts_of({5, {{0, 1, 3}}}), (Counts{2, 0, 0, 3, 0, 0}));
}

TEST(MeshReport, CountsFacesThatAreThereTwice) {
    // Duplicates, turned in every way, on an open and on a closed mesh; no edge changes for them.
    EXPECT_EQ(counts_of({3, {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}}}), (Counts{0, 2, 0, 3, 0, 0}));
    EXPECT_EQ(counts_of({3, {{0, 1, 2}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}}),
              (Counts{0, 0, 3, 3, 0, 0}));
    Topology closed = kTetrahedron;
    closed.triangles.push_back({2, 1, 0});  // as face 0
    closed.triangles.push_back({3, 1, 0});  // the back of face 1
    EXPECT_EQ(counts_of(closed), (Counts{0, 1, 1, 0, 0, 0}));
}

TEST(MeshReport, CountsFlippedAndCrowdedEdges) {
    Topology flipped = kTetrahedron;
    std::swap(flipped.triangles[3][0], flipped.triangles[3][1]);  // its three edges
    EXPECT_EQ(counts_of(flipped), (Counts{0, 0, 0, 0, 3, 0}));
    // Three sheets on one edge: a book.
    EXPECT_EQ(counts_of({5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}}), (Counts{0, 0, 0, 6, 0, 1}));
}

TEST(MeshReport, LeavesFacesThatNameAVertexTwiceOutOfTheEdges) {
    EXPECT_EQ(counts_of({4, {{0, 1, 2}, {0, 0, 1}, {3, 3, 3}}}), (Counts{0, 0, 0, 3, 0, 0}));
    const Topology topology{4, {{0, 1, 2}, {0, 0, 1}, {3, 3, 3}}};
    EXPECT_EQ(report_pose(topology, kCorners).zero_area_faces, 2u);
}

TEST(MeshReport, CountsFacesWithoutAreaInThisPose) {
    std::vector<Vec3f> folded = kCorners;
    folded[3] = {0.5f, 0, 0};  // on the edge 0 1
    EXPECT_EQ(report_pose(kTetrahedron, folded).zero_area_faces, 1u);
    folded.assign(4, {1, 2, 3});
    EXPECT_EQ(report_pose(kTetrahedron, folded).zero_area_faces, 4u);
    EXPECT_EQ(report_pose(kTetrahedron, folded).coincident_faces, 0u);  // those have area
}

TEST(MeshReport, CountsFacesThatLieOnOthers) {
    // A second tetrahedron of its own vertices in the same place, in another order, one face
    // flipped.
    Topology two{8, kTetrahedron.triangles};
    for (const Triangle& t : kTetrahedron.triangles) {
        two.triangles.push_back({7 - t[1], 7 - t[2], 7 - t[0]});
    }
    std::swap(two.triangles[5][0], two.triangles[5][1]);
    std::vector<Vec3f> positions = kCorners;
    positions.insert(positions.end(), kCorners.rbegin(), kCorners.rend());
    EXPECT_EQ(report_pose(two, positions).coincident_faces, 4u);
    // -0 is where 0 is; a little further off is somewhere else.
    positions[7] = {-0.0f, -0.0f, 0.0f};
    EXPECT_EQ(report_pose(two, positions).coincident_faces, 4u);
    positions[7] = {1e-30f, 0, 0};
    EXPECT_EQ(report_pose(two, positions).coincident_faces, 1u);
    // Duplicates by vertex are another kind; their copies elsewhere lie on them nevertheless.
    two.triangles.push_back(two.triangles[0]);
    EXPECT_EQ(report_pose(two, positions).coincident_faces, 1u);
}

TEST(MeshReport, NormalsCountEveryFaceOnce) {
    // Two faces at a right angle. That one of them is there three times, once turned round, changes
    // nothing.
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const PoseSet once({4, {{0, 1, 2}, {0, 3, 1}}}, {positions});
    const PoseSet thrice({4, {{0, 1, 2}, {0, 3, 1}, {1, 0, 3}, {0, 1, 3}}}, {positions});
    EXPECT_EQ(once.load_pose(0).normals, thrice.load_pose(0).normals);
    EXPECT_EQ(thrice.topology().triangles.size(), 4u);
    // The first decides which side is lit.
    const PoseSet back({3, {{0, 2, 1}, {0, 1, 2}}}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    EXPECT_EQ(back.load_pose(0).normals[0], Vec3f(0, 0, -1));
}

}  // namespace
}  // namespace paim
