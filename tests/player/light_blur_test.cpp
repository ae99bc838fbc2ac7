// Blurred and enlarged maps: constants, means, the shape of a blurred point anywhere, and symmetries.
#include "player/light/blur_latlong.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/base/seed.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"
#include "player/light/enlarge_latlong.h"

namespace paim::player {
namespace {

Image random_map(int width, int height, uint64_t seed) {
    RandomStream random(stream_key(5, 3, static_cast<uint32_t>(seed)));
    Image map(width, height);
    for (Vec3f& pixel : map.pixels) {
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(random.uniform());
    }
    return map;
}

// Over all directions, with exact areas of rows.
Vec3d mean_of(const Image& map) {
    Vec3d sum = Vec3d::Zero();
    for (int y = 0; y < map.height; ++y) {
        const double area = std::cos(kPi * y / map.height) - std::cos(kPi * (y + 1.0) / map.height);
        for (int x = 0; x < map.width; ++x) sum += area * map.at(x, y).cast<double>();
    }
    return sum / (2.0 * map.width);
}

// A map that has 1 over the pixel that holds the direction, divided by the pixel's area.
Image point_at(const Vec3d& direction, int width, int height) {
    Image map(width, height);
    const auto [u, v] = latlong_from_direction(direction);
    const int x = std::min(static_cast<int>(u * width), width - 1);
    const int y = std::min(static_cast<int>(v * height), height - 1);
    const double area =
        (std::cos(kPi * y / height) - std::cos(kPi * (y + 1.0) / height)) * 2.0 * kPi / width;
    map.at(x, y) = Vec3f::Constant(static_cast<float>(1.0 / area));
    return map;
}

TEST(BlurLatlong, KeepsConstantMaps) {
    const Vec3f color(0.25f, 3.0f, 1000.0f);
    for (const auto& [width, height] : {std::pair(256, 128), {64, 32}, {5, 3}, {1, 1}}) {
        for (const double sigma_deg : {0.1, 2.0, 10.0, 45.0, 90.0}) {
            const Image blurred = blur_latlong(Image(width, height, color), sigma_deg);
            ASSERT_EQ(blurred.width, kBlurredWidth);
            ASSERT_EQ(blurred.height, kBlurredHeight);
            for (const Vec3f& pixel : blurred.pixels) {
                // A thousand terms, rounded to float one after the other.
                ASSERT_LT((pixel - color).cwiseQuotient(color).cwiseAbs().maxCoeff(), 2e-5f)
                    << width << " " << sigma_deg;
            }
        }
    }
}

TEST(BlurLatlong, KeepsTheMean) {
    for (const double sigma_deg : {0.1, 5.0, 20.0, 60.0}) {
        const Image map = random_map(200, 100, 1);
        const Image sky = make_sky(64);
        const Image pole = point_at(Vec3d(0.01, 1.0, 0.01), 128, 64);
        for (const Image* image : {&map, &sky, &pole}) {
            const Vec3d before = mean_of(*image);
            const Vec3d after = mean_of(blur_latlong(*image, sigma_deg));
            // A thousand terms, rounded to float one after the other.
            EXPECT_LT((after - before).cwiseQuotient(before).cwiseAbs().maxCoeff(), 2e-5)
                << sigma_deg << " " << image->width;
        }
    }
}

// A blurred point has the same profile at the equator, at the seam, at a pole and in between.
TEST(BlurLatlong, IsTheSameInAllPlaces) {
    constexpr double kSigma_deg = 11.25;  // two pixels of 64 × 32
    const double sigma = kSigma_deg * kPi / 180.0;
    for (const Vec3d& place :
         {Vec3d(0.02, 0.02, 1.0), Vec3d(0.01, 0.02, -1.0), Vec3d(0.001, 1.0, 0.002),
          Vec3d(0.001, -1.0, 0.002), Vec3d(0.5, 0.8, -0.3)}) {
        const EnvironmentLight blurred =
            EnvironmentLight::of_checked(blur_latlong(point_at(place, 64, 32), kSigma_deg));
        const auto [u, v] = latlong_from_direction(place);
        const Vec3d centre = direction_from_latlong((std::floor(u * 64) + 0.5) / 64,
                                                    (std::floor(v * 32) + 0.5) / 32);
        const Vec3d side = centre.unitOrthogonal(), other = centre.cross(side);
        for (const double angle : {0.0, 0.5 * sigma, sigma, 2.0 * sigma}) {
            for (int k = 0; k < 8; ++k) {
                const double phi = 2.0 * kPi * k / 8.0;
                const Vec3d direction =
                    std::cos(angle) * centre +
                    std::sin(angle) * (std::cos(phi) * side + std::sin(phi) * other);
                // Splines add a third of a pixel squared, σ²/12, along both axes. At a pole they add
                // it along meridians only, for which the peak is 1/24 higher.
                const double variance = sigma * sigma * (1.0 + 1.0 / 12.0);
                const double expected = std::exp(-0.5 * angle * angle / variance);
                EXPECT_NEAR(
                    static_cast<double>(blurred.radiance(direction).x()) * 2.0 * kPi * variance,
                    expected, 0.05)
                    << place.transpose() << " " << angle << " " << k;
            }
        }
    }
}

TEST(BlurLatlong, HasNeitherSeamNorPoles) {
    const Image blurred = blur_latlong(random_map(64, 32, 2), 8.0);
    // The largest step between neighbours along the equator, away from the seam.
    float step = 0.0f;
    for (int x = 20; x < 200; ++x) {
        step = std::max(step, (blurred.at(x, 64) - blurred.at(x + 1, 64)).cwiseAbs().maxCoeff());
    }
    for (int y = 0; y < kBlurredHeight; ++y) {
        EXPECT_LT((blurred.at(0, y) - blurred.at(kBlurredWidth - 1, y)).cwiseAbs().maxCoeff(),
                  2.0f * step)
            << y;
    }
    // Pixels of the first and last row lie 1.4 degrees from each other at most, a pixel's width.
    for (const int y : {0, kBlurredHeight - 1}) {
        for (int x = 1; x < kBlurredWidth; ++x) {
            EXPECT_LT((blurred.at(0, y) - blurred.at(x, y)).cwiseAbs().maxCoeff(), 2.0f * step);
        }
    }
}

TEST(BlurLatlong, WiderGaussiansLeaveLess) {
    const Image map = random_map(128, 64, 3);
    float before = 1.0f;
    for (const double sigma_deg : {2.0, 6.0, 20.0, 60.0}) {
        const Image blurred = blur_latlong(map, sigma_deg);
        float largest = 0.0f;
        for (const Vec3f& pixel : blurred.pixels) {
            largest = std::max(largest, (pixel - Vec3f::Constant(0.5f)).cwiseAbs().maxCoeff());
        }
        EXPECT_LT(largest, 0.8f * before) << sigma_deg;
        before = largest;
    }
}

TEST(BlurLatlongDeathTest, RefusesImpossibleWidths) {
    EXPECT_DEATH(blur_latlong(Image(2, 1), 0.0), "check failed");
    EXPECT_DEATH(blur_latlong(Image(2, 1), 91.0), "check failed");
    EXPECT_DEATH(blur_latlong(Image(2, 1), std::nan("")), "check failed");
}

TEST(SmoothIfSmall, LeavesLargeMapsAlone) {
    const Image map = random_map(64, 32, 4);
    EXPECT_TRUE(smooth_if_small(map).pixels == map.pixels);
}

// Pixels of a map of 8 x 4 are 32 pixels wide in the result: values change by less than a tenth of the
// range from pixel to pixel, where blocks would change by up to all of it.
TEST(SmoothIfSmall, ShowsNoBlocks) {
    for (const auto& [width, height] : {std::pair(8, 4), {2, 1}, {63, 31}, {3, 40}}) {
        const Image smooth = smooth_if_small(random_map(width, height, 5));
        ASSERT_EQ(smooth.width, kBlurredWidth);
        const float pixels = static_cast<float>(kBlurredWidth) / static_cast<float>(width);
        for (int y = 0; y < smooth.height; ++y) {
            for (int x = 0; x < smooth.width; ++x) {
                const Vec3f& right = smooth.at((x + 1) % smooth.width, y);
                ASSERT_LT((smooth.at(x, y) - right).cwiseAbs().maxCoeff(), 1.0f / pixels);
            }
        }
    }
    EXPECT_EQ(smooth_if_small(Image(1, 1, Vec3f::Ones())).width, kBlurredWidth);
    // Pixels next to a pole lie 1.4 degrees from each other at most, a thirtieth of a pixel of the map.
    const Image smooth = smooth_if_small(random_map(8, 4, 8));
    for (int x = 1; x < smooth.width; ++x) {
        ASSERT_LT((smooth.at(0, 0) - smooth.at(x, 0)).cwiseAbs().maxCoeff(), 0.03f);
    }
}

TEST(EnlargeLatlong, KeepsConstantsAndRanges) {
    for (const Vec3f& pixel : enlarge_latlong(Image(3, 2, Vec3f(1, 2, 3)), 50, 20).pixels) {
        ASSERT_LT((pixel - Vec3f(1, 2, 3)).cwiseAbs().maxCoeff(), 1e-6f);
    }
    const Image random = enlarge_latlong(random_map(6, 3, 6), 60, 33);
    for (const Vec3f& pixel : random.pixels) {
        EXPECT_GE(pixel.minCoeff(), 0.0f);
        EXPECT_LE(pixel.maxCoeff(), 1.0f);
    }
}

// Cubic B-splines keep straight lines, here along longitude, away from where it wraps.
TEST(EnlargeLatlong, KeepsLines) {
    Image map(12, 5);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 12; ++x) map.at(x, y) = Vec3f::Constant(static_cast<float>(x));
    }
    const Image large = enlarge_latlong(map, 60, 17);
    for (int x = 10; x < 50; ++x) {
        EXPECT_NEAR(large.at(x, 8).x(), (static_cast<float>(x) + 0.5f) / 5.0f - 0.5f, 1e-5f);
    }
}

TEST(EnlargeLatlong, KeepsTheMean) {
    for (const auto& [width, height] : {std::pair(8, 4), {7, 3}, {3, 2}, {1, 1}, {40, 33}}) {
        for (int row = 0; row < height; ++row) {  // each by itself
            Image map(width, height);
            for (int x = 0; x < width; ++x) map.at(x, row) = Vec3f::Ones();
            const double before = mean_of(map).x();
            EXPECT_NEAR(mean_of(enlarge_latlong(map, 101, 64)).x(), before, 1e-6 * before)
                << height << " " << row;
        }
    }
}

TEST(EnlargeLatlong, TurnsWithTheMap) {
    const Image map = random_map(7, 4, 7);
    Image shifted = map, upside_down = map;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 7; ++x) {
            shifted.at((x + 2) % 7, y) = map.at(x, y);
            upside_down.at(6 - x, 3 - y) = map.at(x, y);
        }
    }
    const Image large = enlarge_latlong(map, 70, 20),
                large_shifted = enlarge_latlong(shifted, 70, 20);
    const Image large_upside_down = enlarge_latlong(upside_down, 70, 20);
    for (int y = 0; y < 20; ++y) {
        for (int x = 0; x < 70; ++x) {
            EXPECT_LT((large.at(x, y) - large_shifted.at((x + 20) % 70, y)).norm(), 2e-6f);
            EXPECT_LT((large.at(x, y) - large_upside_down.at(69 - x, 19 - y)).norm(), 2e-6f);
        }
    }
}

// Two rows of 1 on one side of the pole and 0 on the other are half bright at the pole, as the splines
// go on at the opposite longitude.
TEST(EnlargeLatlong, GoesOnBehindThePoles) {
    Image map(8, 6);
    for (const int y : {0, 1}) {
        for (int x = 0; x < 4; ++x) map.at(x, y) = Vec3f::Ones();
    }
    const Image large = enlarge_latlong(map, 8, 6000);
    // The first row lies 1/2000 of a row of the map from the pole, and values change by less than 1 a
    // row.
    EXPECT_NEAR(large.at(1, 0).x(), 0.5f, 0.001f);
    EXPECT_NEAR(large.at(5, 0).x(), 0.5f, 0.001f);
}

}  // namespace
}  // namespace paim::player
