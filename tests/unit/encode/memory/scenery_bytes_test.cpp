// The memory of scenery, as planned before a bake and as a bake holds it.
#include <gtest/gtest.h>

#include "compressor/bake/bake_sequence.h"
#include "compressor/encode/memory/memory_plan.h"
#include "poses/octopus.h"
#include "tests/temporary_directory.h"

namespace paim {
namespace {

TEST(SceneryBytes, AreTheArraysThatABakeHolds) {
    const TemporaryDirectory directory;
    Surroundings surroundings;
    surroundings.scenery.add(poses::make_octopus(1500, 1));
    BakeOptions options;
    options.bands = 3;
    options.rays = 2;
    options.bounces = 1;  // the octopus has colours, so that planes have three channels
    bake_sequence(
        poses::make_octopus(1000, 1), options, "faces", directory / "x.bake", 0, 0, [](uint32_t) {},
        surroundings);
    const BakeReader bake(directory / "x.bake");
    ASSERT_EQ(bake.identity().layout.channels, 3u);
    ASSERT_TRUE(bake.scenery());
    const BakedPose& pose = bake.scenery()->pose;
    const uint64_t held = sizeof(float) * (pose.positions.size() + pose.normals.size() +
                                           pose.transfer.size() + pose.noise.size()) +
                          sizeof(Triangle) * bake.scenery()->topology.triangles.size() +
                          sizeof(Vec3f) * bake.scenery()->albedo.values.size();
    EXPECT_EQ(bake_size(bake).scenery_bytes, held);
    EXPECT_EQ(scenery_bytes(surroundings.scenery.topology, surroundings.scenery.albedo,
                            bake.identity().layout),
              held);
}

}  // namespace
}  // namespace paim
