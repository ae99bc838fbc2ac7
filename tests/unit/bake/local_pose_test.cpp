// A baked pose in local coordinates: the same body under the same light.
#include "compressor/bake/local_pose.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/light/light.h"
#include "paim/sh/rotate.h"
#include "paim/shade/shade.h"
#include "tests/gloss_light.h"

namespace paim {
namespace {

constexpr uint32_t kVertices = 5;

std::vector<float> random_values(size_t count, uint64_t seed) {
    RandomStream random(seed);
    std::vector<float> values(count);
    for (float& value : values) value = static_cast<float>(2.0 * random.uniform() - 1.0);
    return values;
}

BakedPose random_pose(const TransferLayout& layout) {
    BakedPose pose;
    pose.positions = random_values(3 * kVertices, 1);
    pose.normals = random_values(3 * kVertices, 2);
    pose.transfer = random_values(size_t{layout.num_planes()} * kVertices, 3);
    pose.noise = random_values(size_t{layout.num_planes()} * kVertices, 4);
    return pose;
}

RigidTransform some_root() {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(1.3, Vec3d(2, -1, 1).normalized())),
            Vec3d(3, 4, 5)};
}

// Lit in local axes by the light that is turned there, it has the radiance that it had before.
TEST(MoveToLocal, KeepsTheRadiance) {
    for (const uint32_t channels : {1u, 3u}) {
        const TransferLayout layout{TransferKind::diffuse, 4, channels};
        const BakedPose before = random_pose(layout);
        BakedPose after = before;
        move_to_local(some_root(), Vec3d::Zero(), layout, after);
        LightCoefficients light{4, {}};
        const std::vector<float> numbers = random_values(3 * 16, 5);
        for (size_t i = 0; i < 16; ++i) {
            light.values.emplace_back(numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]);
        }
        std::vector<Vec3f> expected, got;
        shade(layout, before.transfer, {}, light, expected);
        shade(layout, after.transfer, {}, to_local(light, some_root()), got);
        for (size_t v = 0; v < kVertices; ++v) {
            EXPECT_LT((got[v] - expected[v]).norm(), 1e-5f) << v;
        }
        EXPECT_NE(after.noise, before.noise);
        double energy_before = 0.0, energy_after = 0.0;
        for (const float n : before.noise) energy_before += double{n} * n;
        for (const float n : after.noise) energy_after += double{n} * n;
        EXPECT_NEAR(energy_after, energy_before, 1e-5 * energy_before);
    }
}

// Light that turns with the axes makes the same glossy radiance, whose directions are in frames of the
// vertices; rows of a floor stay.
TEST(MoveToLocal, TurnsTheLightOfGlossyTransfer) {
    const TransferLayout layout{TransferKind::glossy, 3, 3, 2};
    constexpr uint32_t kFollowing = 3;
    BakedPose before;
    before.gloss = random_values(size_t{layout.num_planes()} * kVertices, 6);
    before.gloss_noise = random_values(size_t{layout.num_planes()} * kVertices, 7);
    BakedPose after = before;
    turn_gloss(some_root(), layout, after, kFollowing);
    const Eigen::Matrix3d to_local = some_root().rotation.conjugate().toRotationMatrix();
    std::vector<double> light(9), turned(9);
    for (size_t i = 0; i < 9; ++i) light[i] = static_cast<double>(before.gloss[i]);
    sh::Rotation(3, to_local).apply(std::span<const double>(light), std::span(turned));
    const Vec3d view = Vec3d(0.3, -0.8, 0.4).normalized();
    for (const auto member : {&BakedPose::gloss, &BakedPose::gloss_noise}) {
        for (size_t r = 0; r < kVertices; ++r) {
            const bool follows = r < kFollowing;
            const std::vector<double>& local_light = follows ? turned : light;
            // Some 40 products of about 1, rounded to float.
            EXPECT_NEAR(gloss_radiance(layout, after.*member, r, local_light, view, 2),
                        gloss_radiance(layout, before.*member, r, light, view, 2), 1e-5)
                << r;
        }
    }
}

TEST(MoveToLocal, MovesPositionsAndTurnsNormals) {
    const TransferLayout layout{TransferKind::diffuse, 2, 1};
    const BakedPose before = random_pose(layout);
    BakedPose after = before;
    const Vec3d offset(1e6, 0, -1e6);
    RigidTransform root = some_root();
    root.translation += offset;
    move_to_local(root, offset, layout, after);
    const auto vector = [](const std::vector<float>& planes, size_t v) {
        return Vec3d(double{planes[v]}, double{planes[kVertices + v]},
                     double{planes[2 * kVertices + v]});
    };
    for (size_t v = 0; v < kVertices; ++v) {
        const Vec3d scene = root.to_scene(vector(after.positions, v)) - offset;
        EXPECT_LT((scene - vector(before.positions, v)).norm(), 1e-6) << v;
        const Vec3d normal = root.rotation * vector(after.normals, v);
        EXPECT_LT((normal - vector(before.normals, v)).norm(), 1e-6) << v;
    }
}

// A floor keeps its place, its axes and its transfer; the body is moved as without a floor.
TEST(MoveToLocal, LeavesAFloorAsItIs) {
    const TransferLayout layout{TransferKind::diffuse, 3, 3};
    constexpr uint32_t kFollowing = 3;
    const BakedPose before = random_pose(layout);
    BakedPose whole = before, after = before;
    move_to_local(some_root(), Vec3d::Zero(), layout, whole);
    move_to_local(some_root(), Vec3d::Zero(), layout, after, kFollowing);
    for (const auto member :
         {&BakedPose::positions, &BakedPose::normals, &BakedPose::transfer, &BakedPose::noise}) {
        const std::vector<float>& values = after.*member;
        for (size_t j = 0; j < values.size(); ++j) {
            const bool follows = j % kVertices < kFollowing;
            EXPECT_EQ(values[j], (follows ? whole.*member : before.*member)[j]) << j;
        }
    }
    EXPECT_NE(whole.noise, before.noise);
}

// An outlier at the end of the range of floats may be beyond it when it is turned.
TEST(MoveToLocal, StaysFinite) {
    const TransferLayout layout{TransferKind::diffuse, 2, 1};
    BakedPose pose = random_pose(layout);
    for (size_t axis = 0; axis < 3; ++axis) pose.positions[axis * kVertices] = 3e38f;
    move_to_local(some_root(), Vec3d::Zero(), layout, pose);
    for (const float x : pose.positions) EXPECT_TRUE(std::isfinite(x));
}

}  // namespace
}  // namespace paim
