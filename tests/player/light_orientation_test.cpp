// Turning an environment: the order of the angles, the way back from a rotation, and drags.
#include "player/light/light_orientation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/light/light.h"
#include "paim/shade/camera.h"
#include "tests/unit/sh/directions.h"

namespace paim::player {
namespace {

// Three factors with entries of 1, and angles of 180 degrees, each to 2^-53.
constexpr double kRounding = 5e-15;

double difference(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
    return (a - b).cwiseAbs().maxCoeff();
}

double random_angle_deg(RandomStream& random) {
    return 360.0 * random.uniform() - 180.0;
}

Camera camera_from(const Vec3f& eye) {
    Camera camera;
    camera.eye = eye;
    return camera;
}

TEST(LightOrientation, YawIsTheRotationOfTheOption) {
    LightCoefficients light{4, std::vector<Vec3f>(16)};
    for (size_t i = 0; i < 16; ++i) {
        const auto x = static_cast<float>(i);
        light.values[i] = Vec3f(std::sin(x), std::cos(x), std::sin(3.0f * x));
    }
    for (const double angle_deg : {0.0, 30.0, -90.0, 170.0, 400.0, -36000.0}) {
        const Eigen::Matrix3d rotation = LightOrientation{angle_deg, 0.0, 0.0}.rotation();
        const LightCoefficients expected = turn_about_y(light, angle_deg * kPi / 180.0);
        const LightCoefficients turned = turn(light, rotation);
        for (size_t i = 0; i < 16; ++i) {
            // Rounding to float of values of about 1. 36000 degrees in radians are off by 2^-53 of
            // 628.
            EXPECT_LT((turned.values[i] - expected.values[i]).cwiseAbs().maxCoeff(), 1e-6f)
                << angle_deg;
        }
    }
}

// Roll takes X to Y, pitch Y to Z, yaw Z to X: in this order, and exactly.
TEST(LightOrientation, TurnsByRollThenPitchThenYaw) {
    const auto turned = [](double yaw, double pitch, double roll, const Vec3d& d) -> Vec3d {
        return LightOrientation{yaw, pitch, roll}.rotation() * d;
    };
    EXPECT_EQ(turned(90, 0, 0, Vec3d::UnitZ()), Vec3d::UnitX());
    EXPECT_EQ(turned(0, 90, 0, Vec3d::UnitY()), Vec3d::UnitZ());
    EXPECT_EQ(turned(0, 0, 90, Vec3d::UnitX()), Vec3d::UnitY());
    EXPECT_EQ(turned(90, 90, 90, Vec3d::UnitX()), Vec3d::UnitX());
    EXPECT_EQ(turned(90, 90, 0, Vec3d::UnitY()), Vec3d::UnitX());
    EXPECT_EQ(turned(0, 90, 90, Vec3d::UnitX()), Vec3d::UnitZ());
    EXPECT_EQ(turned(-180, 0, 0, Vec3d::UnitZ()), -Vec3d::UnitZ());
}

TEST(LightOrientation, WrapsAngles) {
    const LightOrientation wrapped = LightOrientation{190.0, -540.0, 720.5}.wrapped();
    EXPECT_EQ(wrapped.yaw_deg, -170.0);
    EXPECT_EQ(std::abs(wrapped.pitch_deg), 180.0);
    EXPECT_EQ(wrapped.roll_deg, 0.5);
}

TEST(LightOrientation, ComesBackFromItsRotation) {
    RandomStream random(stream_key(5, 1, 1));
    for (int trial = 0; trial < 200; ++trial) {
        const LightOrientation orientation{
            random_angle_deg(random), 0.499 * random_angle_deg(random), random_angle_deg(random)};
        const LightOrientation back =
            LightOrientation::of_rotation(orientation.rotation(), /*roll_at_pole_deg=*/12.0);
        // The smallest cosine of a pitch is 1/300, which multiplies rounding.
        EXPECT_NEAR(back.yaw_deg, orientation.yaw_deg, 1e-10);
        EXPECT_NEAR(back.pitch_deg, orientation.pitch_deg, 1e-10);
        EXPECT_NEAR(back.roll_deg, orientation.roll_deg, 1e-10);
    }
}

// At the poles and close to them the angles are another triple, but the rotation is the same.
TEST(LightOrientation, KeepsTheRotationAtThePoles) {
    RandomStream random(stream_key(5, 1, 2));
    for (const double pole_deg : {90.0, -90.0}) {
        for (const double off_deg : {0.0, 1e-13, 1e-9, 1e-7, 1e-5, 1e-2}) {
            for (int trial = 0; trial < 20; ++trial) {
                const LightOrientation orientation{random_angle_deg(random), pole_deg + off_deg,
                                                   random_angle_deg(random)};
                const Eigen::Matrix3d rotation = orientation.rotation();
                const LightOrientation back = LightOrientation::of_rotation(rotation, 33.0);
                // Below the least cosine, 1e-8, the roll is another, and what that leaves out is as
                // small.
                EXPECT_LT(difference(back.rotation(), rotation), off_deg > 1e-6 ? kRounding : 2e-8)
                    << off_deg;
                EXPECT_TRUE(off_deg > 5e-7 || back.roll_deg == 33.0) << off_deg;
            }
        }
    }
}

TEST(LightDrag, MovesALightBehindTheCameraWithThePointer) {
    RandomStream random(stream_key(5, 1, 3));
    for (int trial = 0; trial < 20; ++trial) {
        const Camera camera = camera_from(random_direction(random).cast<float>());
        const Eigen::Matrix3f axes = camera.axes();
        const Vec3d right = axes.col(0).cast<double>(), up = axes.col(1).cast<double>();
        const Vec3d backward = axes.col(2).cast<double>();
        const LightOrientation before{random_angle_deg(random), 0.4 * random_angle_deg(random),
                                      random_angle_deg(random)};
        // Where in the environment the light is that comes from behind the camera.
        const Vec3d sun = before.rotation().transpose() * backward;
        const auto after = [&](double dx, double dy) -> Vec3d {
            return drag(before, axes, dx, dy).rotation() * sun;
        };
        // The axes are floats.
        EXPECT_LT((after(0.5, 0.0) - right).norm(), 1e-6);
        EXPECT_LT((after(-0.5, 0.0) + right).norm(), 1e-6);
        EXPECT_LT((after(0.0, 0.5) + up).norm(), 1e-6);
        EXPECT_LT((after(0.0, -0.5) - up).norm(), 1e-6);
        EXPECT_LT((after(1.0, 0.0) + backward).norm(), 1e-6);
        EXPECT_LT((after(0.25, -0.25) - after(0.0, 0.0)).dot(right - up), 2.0);
        EXPECT_GT(after(0.25, -0.25).dot(right), 0.3);
        EXPECT_GT(after(0.25, -0.25).dot(up), 0.3);
    }
}

TEST(LightDrag, OfALevelCameraIsYawAlone) {
    const Eigen::Matrix3f axes = camera_from(Vec3f(0.6f, 0.0f, 0.8f)).axes();
    const LightOrientation after = drag({170.0, 20.0, -5.0}, axes, 0.1, 0.0);
    EXPECT_NEAR(after.yaw_deg, -172.0, 1e-5);
    EXPECT_NEAR(after.pitch_deg, 20.0, 1e-5);
    EXPECT_NEAR(after.roll_deg, -5.0, 1e-5);
    EXPECT_EQ(drag({170.0, 20.0, -5.0}, axes, 0.0, 0.0), (LightOrientation{170.0, 20.0, -5.0}));
}

// 200 drags over the pole: each turns the environment by its own angle, about the camera's axis.
TEST(LightDrag, GoesOverThePole) {
    const Eigen::Matrix3f axes = camera_from(Vec3f::UnitZ()).axes();
    LightOrientation orientation;
    Eigen::Matrix3d expected = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d step =
        Eigen::AngleAxisd(1.8 * kPi / 180.0, Vec3d::UnitX()).toRotationMatrix();
    for (int i = 0; i < 200; ++i) {
        orientation = drag(orientation, axes, 0.0, 0.01);
        expected = step * expected;
        // At the pole, which is the 50th and the 150th step, what the angles leave out is 1e-8.
        ASSERT_LT(difference(orientation.rotation(), expected), 1e-7) << i;
        ASSERT_LE(std::abs(orientation.pitch_deg), 90.0);
    }
}

}  // namespace
}  // namespace paim::player
