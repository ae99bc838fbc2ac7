// Splitting the edges of a closed mesh.
#include "poses/ring_mesh.h"

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

}  // namespace
}  // namespace paim::poses
