// The ball's pixels against look-ups of the map, the reconstruction, and the key light's place.
#include "player/light/light_globe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/shade/camera.h"
#include "player/light/reconstruct_light.h"

namespace paim::player {
namespace {

constexpr int kGlobeSize = 32;

const Vec3f& background() {
    static const Vec3f color(0.2f, 0.0f, 7.0f);
    return color;
}

// 100 from within 15 degrees of the direction, 1 elsewhere.
Image map_with_sun(const Vec3d& towards) {
    Image map(128, 64, Vec3f::Ones());
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Vec3d d = direction_from_latlong((x + 0.5) / map.width, (y + 0.5) / map.height);
            if (d.dot(towards) > std::cos(15.0 * kPi / 180.0)) map.at(x, y) *= 100.0f;
        }
    }
    return map;
}

Eigen::Matrix3f axes_from(const Vec3f& eye) {
    Camera camera;
    camera.eye = eye;
    return camera.axes();
}

// Colour of the direction, about 1.
Image map_of_directions() {
    Image map(128, 64);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const Vec3d d = direction_from_latlong((x + 0.5) / map.width, (y + 0.5) / map.height);
            map.at(x, y) = (Vec3d::Ones() + 0.9 * d).cast<float>();
        }
    }
    return map;
}

// Centre of mass of what is brighter than 10, in radii of the ball, right and up positive.
std::vector<Vec3d> bright_pixels(const Image& image) {
    std::vector<Vec3d> found;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y).x() <= 10.0f) continue;
            found.emplace_back((2.0 * x + 1.0) / image.width - 1.0,
                               1.0 - (2.0 * y + 1.0) / image.height, 0.0);
        }
    }
    return found;
}

Vec3d mean_of(const std::vector<Vec3d>& places) {
    Vec3d sum = Vec3d::Zero();
    for (const Vec3d& place : places) sum += place;
    return sum / static_cast<double>(places.size());
}

TEST(LightGlobe, ShowsLightWhereItArrives) {
    const Eigen::Matrix3f axes = axes_from(Vec3f(1.0f, 0.7f, -0.4f));
    const auto bright = [&](const Vec3f& towards) {
        LightRig rig{EnvironmentLight(map_with_sun(towards.cast<double>()))};
        return bright_pixels(LightGlobe().draw(rig, axes, 3, kGlobeSize, Vec3f::Zero()).light);
    };
    // Behind the camera: the middle. To the right and above: the rims, half of the disc. In front:
    // on the far side.
    EXPECT_LT(mean_of(bright(axes.col(2))).norm(), 0.05);
    const Vec3d right = mean_of(bright(axes.col(0)));
    EXPECT_GT(right.x(), 0.9);
    EXPECT_NEAR(right.y(), 0.0, 0.05);
    const Vec3d above = mean_of(bright(axes.col(1)));
    EXPECT_GT(above.y(), 0.9);
    EXPECT_NEAR(above.x(), 0.0, 0.05);
    EXPECT_TRUE(bright(-axes.col(2)).empty());
}

TEST(LightGlobe, PixelsAreTheTurnedMap) {
    const EnvironmentLight environment(map_of_directions());
    LightRig rig(environment);
    rig.set_orientation({30.0, -50.0, 70.0});
    rig.set_environment_strength(0.5f);
    const Eigen::Matrix3f axes = axes_from(Vec3f(-0.3f, -0.2f, 0.9f));
    const Image globe = LightGlobe().draw(rig, axes, 3, kGlobeSize, background()).light;
    int inside = 0;
    for (int y = 0; y < kGlobeSize; ++y) {
        for (int x = 0; x < kGlobeSize; ++x) {
            const double right = (2.0 * x + 1.0) / kGlobeSize - 1.0;
            const double up = 1.0 - (2.0 * y + 1.0) / kGlobeSize;
            const double rest = 1.0 - right * right - up * up;
            if (rest < 0.0) {
                EXPECT_EQ(globe.at(x, y), background());
                continue;
            }
            ++inside;
            const Vec3d direction = axes.cast<double>() * Vec3d(right, up, std::sqrt(rest));
            const Vec3f expected =
                0.5f * environment.radiance(rig.orientation().rotation().transpose() * direction);
            // Floats of directions, where the map changes by 1 a radian.
            EXPECT_LT((globe.at(x, y) - expected).cwiseAbs().maxCoeff(), 2e-6f);
        }
    }
    // π/4 of the square.
    EXPECT_NEAR(inside, kPi / 4.0 * kGlobeSize * kGlobeSize, 10);
}

// Light that two bands hold is the same in both pictures, up to the map's interpolation.
TEST(LightGlobe, ReconstructionIsTheLightThatBandsHold) {
    LightRig rig{EnvironmentLight(map_of_directions())};
    rig.set_orientation({-120.0, 15.0, 5.0});
    const auto pictures =
        LightGlobe().draw(rig, axes_from(Vec3f(0.5f, 0.5f, 0.5f)), 2, kGlobeSize, background());
    for (size_t i = 0; i < pictures.light.pixels.size(); ++i) {
        // Pixels of 2.8 degrees: projection and interpolation are off by (0.049)²/12 and /8.
        EXPECT_LT(
            (pictures.light.pixels[i] - pictures.reconstruction.pixels[i]).cwiseAbs().maxCoeff(),
            1e-3f);
    }
    EXPECT_EQ(pictures.negative_share, 0.0);
}

TEST(LightGlobe, ReportsWhatRingsBelowZero) {
    LightRig rig{EnvironmentLight(map_with_sun(Vec3d::UnitY()))};
    LightGlobe globe;
    const Eigen::Matrix3f axes = axes_from(Vec3f::UnitZ());
    const auto pictures = globe.draw(rig, axes, 5, kGlobeSize, Vec3f::Zero());
    EXPECT_GT(pictures.negative_share, 0.1);
    EXPECT_EQ(pictures.negative_share, negative_share(rig.coefficients(5)));
    float least = 1.0f;
    for (const Vec3f& pixel : pictures.reconstruction.pixels) {
        least = std::min(least, pixel.minCoeff());
    }
    EXPECT_EQ(least, 0.0f);
    // One band is the mean, which is not negative.
    EXPECT_EQ(globe.draw(rig, axes, 1, kGlobeSize, Vec3f::Zero()).negative_share, 0.0);
}

TEST(LightGlobe, ShowsTheKeyLightInBoth) {
    LightRig rig{EnvironmentLight(Image(4, 2, Vec3f::Ones()))};
    KeyLight key;  // behind the camera and to the right
    key.azimuth_deg = 30.0;
    key.elevation_deg = 0.0;
    key.angular_diameter_deg = 40.0;
    key.strength = 100.0;
    rig.set_key_light(key);
    rig.set_orientation({77.0, 0.0, 0.0});  // does not turn it
    const auto pictures = LightGlobe().draw(rig, axes_from(Vec3f::UnitZ()), 8, 128, Vec3f::Zero());
    const std::vector<Vec3d> bright = bright_pixels(pictures.light);
    // sin 30° · cos 20°: the mean over the disc as it is seen from the side.
    EXPECT_NEAR(mean_of(bright).x(), 0.5 * (1.0 + std::cos(20.0 * kPi / 180.0)) / 2.0, 0.02);
    EXPECT_NEAR(mean_of(bright).y(), 0.0, 0.01);
    // The disc's area, cos 30° · π sin² 20° of the ball's radius squared, in pixels: its rim of 130
    // pixels is in or out.
    const double expected = std::cos(kPi / 6.0) * kPi * std::pow(std::sin(kPi / 9.0), 2) * 64 * 64;
    EXPECT_NEAR(static_cast<double>(bright.size()), expected, 0.02 * expected);
    EXPECT_FLOAT_EQ(pictures.light.at(95, 64).x(),
                    static_cast<float>(1.0 + key.disc_radiance().x()));
    // Brightest near the light, dark on the left.
    EXPECT_GT(pictures.reconstruction.at(95, 64).x(), 0.5f * pictures.light.at(95, 64).x());
    EXPECT_LT(pictures.reconstruction.at(15, 64).x(), 0.1f * pictures.light.at(95, 64).x());
}

TEST(LightGlobe, ShowsTheSmallestKeyLight) {
    LightRig rig{EnvironmentLight(Image(4, 2))};
    KeyLight key;
    key.angular_diameter_deg = KeyLight::kMinDiameter_deg;
    key.strength = 100.0;
    rig.set_key_light(key);
    for (const double azimuth_deg : {0.0, 0.3, 1.1, 17.0, 40.0}) {
        key.azimuth_deg = azimuth_deg;
        key.elevation_deg = 20.0;
        rig.set_key_light(key);
        const auto pictures =
            LightGlobe().draw(rig, axes_from(Vec3f::UnitZ()), 3, 64, Vec3f::Zero());
        EXPECT_GE(bright_pixels(pictures.light).size(), 2u) << azimuth_deg;
    }
}

TEST(LightGlobe, DrawsTheSameAgain) {
    LightRig rig{EnvironmentLight(map_of_directions())};
    const Eigen::Matrix3f axes = axes_from(Vec3f(0.1f, 0.2f, 1.0f));
    LightGlobe globe;
    const auto first = globe.draw(rig, axes, 4, kGlobeSize, background());
    EXPECT_EQ(globe.draw(rig, axes, 4, 20, background()).light.width, 20);
    const auto again = globe.draw(rig, axes, 4, kGlobeSize, background());
    EXPECT_TRUE(first.light.pixels == again.light.pixels);
    EXPECT_TRUE(first.reconstruction.pixels == again.reconstruction.pixels);
    // After smaller ones, too, for which the map is averaged down.
    LightGlobe other;
    other.draw(rig, axes, 4, 8, background());
    EXPECT_TRUE(first.light.pixels ==
                other.draw(rig, axes, 4, kGlobeSize, background()).light.pixels);
    // Another map is another picture, and large ones are averaged, not sampled: a map of black and
    // white pixels is grey.
    Image board(1024, 512);
    for (int y = 0; y < board.height; ++y) {
        for (int x = y % 2; x < board.width; x += 2) board.at(x, y) = Vec3f::Constant(2.0f);
    }
    rig.set_environment(EnvironmentLight(board));
    const Image grey = globe.draw(rig, axes, 4, kGlobeSize, Vec3f::Ones()).light;
    for (const Vec3f& pixel : grey.pixels) EXPECT_LT((pixel - Vec3f::Ones()).norm(), 1e-3f);
}

}  // namespace
}  // namespace paim::player
