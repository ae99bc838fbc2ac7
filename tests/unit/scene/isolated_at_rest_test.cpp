// Vertices of no face lie still, where they change nothing.
#include "compressor/scene/isolated_at_rest.h"

#include <gtest/gtest.h>

#include <limits>

#include "compressor/bake/bake_sequence.h"
#include "paim/mesh/pose_set.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

// A triangle between two vertices of no face, in two poses.
// shift  of the triangle
PoseSet triangle(const Vec3f& shift, const Vec3f& first, const Vec3f& last) {
    const std::vector<Vec3f> corners{{1, -1, 2}, {2, -1, 2}, {1, 1, 3}};
    std::vector<std::vector<Vec3f>> poses;
    for (const float time : {0.0f, 1.0f}) {
        poses.push_back({(1.0f + time) * first});
        for (const Vec3f& corner : corners) poses.back().push_back(corner + (1 + time) * shift);
        poses.back().push_back((1.0f - time) * last);
    }
    return PoseSet({5, {{1, 2, 3}}}, poses);
}

TEST(IsolatedAtRest, LieAtThePlaceOfTheFirstPoseThatIsNearestToTheOrigin) {
    const PoseSet poses = triangle({0, 0, 0}, {40, 0, 0}, {7, 8, 9});
    const IsolatedAtRest resting(poses);
    for (const uint32_t p : {0u, 1u}) {
        const Pose pose = resting.load_pose(p);
        EXPECT_EQ(pose.positions[0], Vec3f(1, 0, 2)) << p;  // bounds 1 … 2, −1 … 1, 2 … 3
        EXPECT_EQ(pose.positions[4], Vec3f(1, 0, 2)) << p;
        EXPECT_TRUE(pose.normals[0].isZero(0.0f));
        const Pose given = poses.load_pose(p);
        for (const size_t v : {1, 2, 3}) {
            EXPECT_EQ(pose.positions[v], given.positions[v]);
            EXPECT_EQ(pose.normals[v], given.normals[v]);
        }
    }
    // The first pose decides.
    const PoseSet moved = triangle({-1, 5, -9}, {40, 0, 0}, {7, 8, 9});
    EXPECT_EQ(IsolatedAtRest(moved).load_pose(1).positions[4], Vec3f(0, 4, -6));
}

TEST(IsolatedAtRest, NeedNotBeFinite) {
    const float infinity = std::numeric_limits<float>::infinity();
    const PoseSet poses = triangle({0, 0, 0}, {infinity, 1e30f, 0}, {0, 0, -infinity});
    for (const Vec3f& position : IsolatedAtRest(poses).load_pose(1).positions) {
        EXPECT_TRUE(position.allFinite());
    }
}

// A bake that was begun with another place is another bake.
TEST(IsolatedAtRest, PlaceIsInTheChecksums) {
    const PoseSet poses = triangle({0, 0, 0}, {40, 0, 0}, {7, 8, 9});
    EXPECT_NE(IsolatedAtRest(poses).pose_checksum(1), poses.pose_checksum(1));
    const PoseSet connected({3, {{0, 1, 2}}}, {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}});
    EXPECT_EQ(IsolatedAtRest(connected).pose_checksum(0), connected.pose_checksum(0));
    EXPECT_EQ(IsolatedAtRest(connected).load_pose(0).positions, connected.load_pose(0).positions);
}

TEST(IsolatedAtRest, AreSoInBakesAndStillMeshes) {
    const PoseSet poses = triangle({0, 0, 0}, {40, 0, 0}, {7, 8, 9});
    Surroundings surroundings;
    surroundings.still_mesh.add(poses);
    EXPECT_EQ(surroundings.still_mesh.pose.positions[0], Vec3f(1, 0, 2));
    const TemporaryDirectory directory;
    const BakeOptions options{.bands = 1, .rays = 2};
    bake_sequence(
        poses, options, "faces", directory / "x.bake", 0, 1, [](uint32_t) {}, surroundings);
    const BakeReader bake(directory / "x.bake");
    std::vector<float> x(5);
    bake.read_position_rows(1, 0, 5, x.data());
    EXPECT_EQ(x[0], 1.0f);
    EXPECT_EQ(x[4], 1.0f);
    EXPECT_EQ(bake.still_mesh()->pose.positions[4], 1.0f);
}

}  // namespace
}  // namespace paim
