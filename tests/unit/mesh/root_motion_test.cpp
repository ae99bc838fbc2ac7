// Root motion: its transforms at times between poses, and what it does to points.
#include "paim/mesh/root_motion.h"

#include <gtest/gtest.h>

#include <cmath>

namespace paim {
namespace {

RigidTransform turned(double angle_deg, const Vec3d& axis, const Vec3d& translation) {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(angle_deg * kPi / 180.0, axis)), translation};
}

TEST(RootAt, IsTheIdentityWithoutMotion) {
    EXPECT_TRUE(root_at({}, 3.5).is_identity());
}

TEST(RootAt, IsThePosesAndClampsTimes) {
    const RootMotion motion{turned(0, Vec3d::UnitY(), {1, 2, 3}),
                            turned(90, Vec3d::UnitY(), {5, 2, 3})};
    EXPECT_EQ(root_at(motion, 0.0), motion[0]);
    EXPECT_EQ(root_at(motion, 1.0), motion[1]);
    EXPECT_EQ(root_at(motion, -4.0), motion[0]);
    EXPECT_EQ(root_at(motion, 9.0), motion[1]);
    EXPECT_EQ(root_at(motion, std::nan("")), motion[0]);
}

// A quarter of a quarter turn about Y takes +Z to sin 22.5° in +X.
TEST(RootAt, TurnsAtConstantSpeedBetweenPoses) {
    const RootMotion motion{turned(0, Vec3d::UnitY(), {1, 0, 0}),
                            turned(90, Vec3d::UnitY(), {5, 0, 0})};
    const RigidTransform root = root_at(motion, 0.25);
    EXPECT_NEAR(root.translation.x(), 2.0, 1e-15);
    const Vec3d z = root.rotation * Vec3d::UnitZ();
    EXPECT_NEAR(z.x(), std::sin(22.5 * kPi / 180.0), 1e-12);
    EXPECT_NEAR(z.z(), std::cos(22.5 * kPi / 180.0), 1e-12);
}

// q and −q are the same rotation.
TEST(RootAt, TakesTheShorterArc) {
    RootMotion motion{turned(0, Vec3d::UnitX(), Vec3d::Zero()),
                      turned(40, Vec3d::UnitX(), Vec3d::Zero())};
    motion[1].rotation.coeffs() *= -1.0;
    const double angle = root_at(motion, 0.5).rotation.angularDistance(motion[0].rotation);
    EXPECT_NEAR(angle, 20.0 * kPi / 180.0, 1e-12);
}

TEST(MoveToScene, RotatesThenTranslates) {
    const RigidTransform root = turned(90, Vec3d::UnitY(), {10, 20, 30});
    std::vector<float> planes{0, 1, 0, 2, 1, 3};  // (0, 0, 1) and (1, 2, 3)
    move_to_scene(root, planes);
    // +Z goes to +X, +X to −Z.
    const std::vector<float> expected{11, 13, 20, 22, 30, 29};
    for (size_t j = 0; j < planes.size(); ++j) EXPECT_NEAR(planes[j], expected[j], 1e-5f) << j;
    EXPECT_LT((root.to_local(root.to_scene({1, 2, 3})) - Vec3d(1, 2, 3)).norm(), 1e-13);
}

TEST(MoveToScene, LeavesPointsThatDoNotFollow) {
    std::vector<float> planes{0, 1, 0, 2, 1, 3};
    move_to_scene(turned(90, Vec3d::UnitY(), {10, 20, 30}), planes, 1);
    const std::vector<float> expected{11, 1, 20, 2, 30, 3};
    for (size_t j = 0; j < planes.size(); ++j) EXPECT_NEAR(planes[j], expected[j], 1e-5f) << j;
}

TEST(RotationVector, GoesThereAndBack) {
    for (const double angle : {0.0, 1e-9, 0.5, 2.0, kPi - 1e-9}) {
        const Vec3d vector = angle * Vec3d(2, -1, 2) / 3.0;
        EXPECT_LT((rotation_vector(rotation_of(vector)) - vector).norm(), 1e-14) << angle;
        const Eigen::AngleAxisd expected(angle, Vec3d(2, -1, 2) / 3.0);
        EXPECT_LT(rotation_of(vector).angularDistance(Eigen::Quaterniond(expected)), 1e-7);
    }
    // More than half a turn is less than half the other way.
    EXPECT_LT((rotation_vector(rotation_of({0, 4, 0})) - Vec3d(0, 4 - 2 * kPi, 0)).norm(), 1e-14);
}

TEST(TravelOf, AddsUpThePathAndTheTurns) {
    const RootMotion motion{turned(0, Vec3d::UnitY(), {0, 0, 0}),
                            turned(30, Vec3d::UnitY(), {3, 0, 0}),
                            turned(10, Vec3d::UnitY(), {3, 4, 0})};
    EXPECT_NEAR(travel_of(motion).distance, 7.0, 1e-12);
    EXPECT_NEAR(travel_of(motion).angle_deg, 50.0, 1e-9);
    EXPECT_EQ(travel_of({}).distance, 0.0);
}

}  // namespace
}  // namespace paim
