// Several still meshes as one, and what they do to the poses' light.
#include "compressor/scene/still_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "compressor/bake/bake_sequence.h"
#include "paim/base/file.h"
#include "paim/mesh/pose_set.h"
#include "poses/shapes.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

// A square of 1 x 1 at the height, facing up.
PoseSet square(float height, const Albedo& albedo) {
    return PoseSet({4, {{0, 2, 1}, {1, 2, 3}}},
                   {{{0, height, 0}, {1, height, 0}, {0, height, 1}, {1, height, 1}}}, albedo);
}

// One of the two plates of the shape of that name, in its first pose.
PoseSet plate(const PoseSet& both, bool upper) {
    const uint32_t half = both.topology().num_vertices / 2;
    const uint32_t first = upper ? half : 0;
    Topology topology{half, {}};
    for (const Triangle& t : both.topology().triangles) {
        if ((t[0] >= half) == upper) {
            topology.triangles.push_back({t[0] - first, t[1] - first, t[2] - first});
        }
    }
    const Pose pose = both.load_pose(0);
    return PoseSet(topology,
                   {{pose.positions.begin() + first, pose.positions.begin() + first + half}});
}

TEST(StillMesh, AddsMeshAfterMesh) {
    StillMesh still_mesh;
    EXPECT_TRUE(still_mesh.empty());
    const Albedo red{{Vec3f(1, 0, 0)}}, blue{{Vec3f(0, 0, 1)}};
    still_mesh.add(square(0, red));
    still_mesh.add(square(1, red));
    EXPECT_EQ(still_mesh.albedo.values.size(), 1u);  // one colour, however many meshes
    EXPECT_EQ(still_mesh.albedo.at(5), red.at(0));
    still_mesh.add(square(2, blue));
    ASSERT_EQ(still_mesh.topology.num_vertices, 12u);
    EXPECT_EQ(still_mesh.topology.triangles[4], (Triangle{8, 10, 9}));
    ASSERT_EQ(still_mesh.albedo.values.size(), 12u);
    EXPECT_EQ(still_mesh.albedo.at(7), red.at(0));
    EXPECT_EQ(still_mesh.albedo.at(8), blue.at(0));
    EXPECT_EQ(still_mesh.pose.positions[9], Vec3f(1, 2, 0));
    EXPECT_EQ(still_mesh.pose.normals.size(), 12u);
    ASSERT_EQ(still_mesh.sources.size(), 3u);
    // Checksums tell heights and colours apart.
    EXPECT_NE(still_mesh.sources[0].xxh3, still_mesh.sources[1].xxh3);
    StillMesh other;
    other.add(square(0, blue));
    EXPECT_NE(other.sources[0].xxh3, still_mesh.sources[0].xxh3);
    EXPECT_EQ(other.sources[0].name, still_mesh.sources[0].name);
}

TEST(StillMesh, BlocksAsIfItWerePartOfTheMesh) {
    const PoseSet both = poses::make_pose_set(*poses::make_plates_sequence(200), 1);
    const PoseSet lower = plate(both, false), upper = plate(both, true);
    StillMesh still_mesh;
    still_mesh.add(upper);
    const BakeOptions options{3, 256, 1};
    const BakedPose whole = TransferBaker(options).bake(both.topology(), both.load_pose(0), 0);
    const BakedPose part =
        TransferBaker(options, {}, still_mesh).bake(lower.topology(), lower.load_pose(0), 0);
    // The same rays against the same triangles: the same numbers.
    const size_t num_all = both.topology().num_vertices, num_lower = num_all / 2;
    for (size_t i = 0; i < 9; ++i) {
        for (size_t v = 0; v < num_lower; ++v) {
            ASSERT_EQ(part.transfer[i * num_lower + v], whole.transfer[i * num_all + v]) << v;
        }
    }
    EXPECT_GT(part.statistics.occluded, 0u);
}

TEST(StillMesh, IsBakedOnceAloneAndFoundAgain) {
    const PoseSet both = poses::make_pose_set(*poses::make_plates_sequence(200), 2);
    const TemporaryDirectory directory;
    const auto bake = directory / "x.bake";
    const BakeOptions options{2, 64, 1};
    Surroundings surroundings;
    surroundings.still_mesh.add(plate(both, true));
    const PoseSet lower = plate(both, false);
    const auto run = [&] {
        bake_sequence(
            lower, options, "faces", bake, 0, 0, [](uint32_t) {}, surroundings);
    };
    run();
    const auto bytes = read_file(bake_still_mesh_file(bake), 1 << 20);
    const BakeReader reader(bake);
    ASSERT_TRUE(reader.still_mesh());
    // Nothing above the upper plate's front, which faces down: open to all below but the lower
    // plate, which it does not see.
    EXPECT_EQ(reader.still_mesh()->pose.statistics.occluded, 0u);
    EXPECT_GT(reader.read_pose(0).statistics.occluded, 0u);
    std::filesystem::remove(bake_still_mesh_file(bake));
    run();  // goes on: the poses are there, the still mesh is baked again
    EXPECT_EQ(read_file(bake_still_mesh_file(bake), 1 << 20), bytes);
}

TEST(StillMesh, BouncesTheSameLightIntoPosesThatAreBakedLater) {
    const PoseSet both = poses::make_pose_set(*poses::make_plates_sequence(200), 1);
    const TemporaryDirectory directory;
    const auto bake = directory / "x.bake";
    BakeOptions options{2, 64, 1};
    options.bounces = 2;
    Surroundings surroundings;
    surroundings.still_mesh.add(plate(both, true));
    const PoseSet lower = plate(both, false);
    const auto run = [&] {
        bake_sequence(
            lower, options, "faces", bake, 0, 0, [](uint32_t) {}, surroundings);
        return read_file(bake_pose_file(bake, 0), 1 << 20);
    };
    const auto bytes = run();
    std::filesystem::remove(bake_pose_file(bake, 0));
    EXPECT_EQ(run(), bytes);  // the still mesh's file is there, its bounces are not
}

}  // namespace
}  // namespace paim
