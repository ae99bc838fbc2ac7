// Splitting and turning the edges of a closed mesh.
#include "poses/mesh_refine.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "tests/unit/poses/mesh_checks.h"

namespace paim::poses {
namespace {

const Topology kTetrahedron{4, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
const std::vector<Vec3d> kCorners{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 1}};

double evenly(const Vec3d&) {
    return 1.0;
}

TEST(SplitLongestEdges, AddsMiddlesAndStaysClosed) {
    Topology topology = kTetrahedron;
    auto positions = kCorners;
    split_longest_edges(1, evenly, topology, positions);
    ASSERT_EQ(positions.size(), 5u);
    // Edges 1-2 and 1-3 are the longest, both √5; the one of lower vertices goes first.
    EXPECT_EQ(positions[4], Vec3d(1.0, 0.5, 0.0));
    EXPECT_EQ(topology.num_vertices, 5u);
    EXPECT_EQ(count_bad_edges(topology), 0);
    EXPECT_EQ(euler_characteristic(topology), 2);
}

TEST(SplitLongestEdges, PrefersWhereFinenessIsAsked) {
    Topology topology = kTetrahedron;
    auto positions = kCorners;
    split_longest_edges(
        1, [](const Vec3d& p) { return p.x() == 0.0 ? 9.0 : 1.0; }, topology, positions);
    EXPECT_EQ(positions[4], Vec3d(0.0, 0.5, 0.5));
}

TEST(SplitLongestEdges, RefusesMoreThanThereIsRoomFor) {
    Topology topology = kTetrahedron;
    auto positions = kCorners;
    // Each split uses up two of the four faces.
    EXPECT_THROW(split_longest_edges(3, evenly, topology, positions), Error);
}

// A square pyramid whose base is a flat kite, halved the long way: two needles that want turning.
TEST(FlipEdges, TurnsNeedlesAndKeepsTheSurface) {
    Topology topology{5, {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    const std::vector<Vec3d> positions{{-4, 0, 0}, {0, -1, 0}, {4, 0, 0}, {0, 1, 0}, {0, 0, 3}};
    flip_edges(1, positions, topology);
    EXPECT_EQ(count_bad_edges(topology), 0);
    EXPECT_EQ(euler_characteristic(topology), 2);
    const auto edges = half_edges(topology);
    EXPECT_EQ(edges.count({0, 2}), 0u);
    EXPECT_EQ(edges.count({1, 3}), 1u);
    std::vector<Vec3f> rounded;
    for (const Vec3d& position : positions) rounded.push_back(position.cast<float>());
    EXPECT_NEAR(signed_volume(topology, rounded), 8.0, 1e-12);  // base 8, height 3
}

// A flat tetrahedron: turning the long edge on top would repeat the one below.
TEST(FlipEdges, NeverMakesAnEdgeTwice) {
    Topology topology = kTetrahedron;
    const std::vector<Vec3d> positions{{-4, 0, 0.2}, {0, -1, 0}, {4, 0, 0.2}, {0, 1, 0}};
    flip_edges(2, positions, topology);
    EXPECT_EQ(topology, kTetrahedron);
}

TEST(Relax, MovesToTheAverageOfNeighbours) {
    std::vector<Vec3d> positions = kCorners;
    relax(
        kTetrahedron, 1, [](const Vec3d& p) { return p; }, positions);
    // Each corner goes half way to the mean of the other three.
    const Vec3d sum(2, 1, 1);
    for (size_t v = 0; v < 4; ++v) {
        EXPECT_LT((positions[v] - (0.5 * kCorners[v] + (sum - kCorners[v]) / 6.0)).norm(), 1e-15);
    }
}

}  // namespace
}  // namespace paim::poses
