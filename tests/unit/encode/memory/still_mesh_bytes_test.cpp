// The memory of a still mesh: planned before a bake, and held by a bake.
#include <gtest/gtest.h>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/memory/memory_plan.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

TEST(StillMeshBytes, AreTheArraysThatABakeHolds) {
    const TemporaryDirectory directory;
    Surroundings surroundings;
    surroundings.still_mesh.add(poses::make_octopus(1500, 1));
    BakeOptions options;
    options.bands = 3;
    options.rays = 2;
    options.bounces = 1;  // the octopus has colours, so that planes have three channels
    bake_sequence(
        poses::make_octopus(1000, 1), options, "faces", directory / "x.bake", 0, 0, [](uint32_t) {},
        surroundings);
    const BakeReader bake(directory / "x.bake");
    ASSERT_EQ(bake.identity().layout.channels, 3u);
    ASSERT_TRUE(bake.still_mesh());
    const BakedPose& pose = bake.still_mesh()->pose;
    const uint64_t held = sizeof(float) * (pose.positions.size() + pose.normals.size() +
                                           pose.transfer.size() + pose.noise.size()) +
                          sizeof(Triangle) * bake.still_mesh()->topology.triangles.size() +
                          sizeof(Vec3f) * bake.still_mesh()->albedo.values.size();
    EXPECT_EQ(bake_size(bake).still_mesh_bytes, held);
    EXPECT_EQ(still_mesh_bytes(surroundings.still_mesh.topology, surroundings.still_mesh.albedo,
                               bake.identity().layout),
              held);
}

}  // namespace
}  // namespace paim
