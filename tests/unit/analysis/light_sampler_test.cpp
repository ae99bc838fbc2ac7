// Directions by the light of a map: densities against sums over pixels.
#include "analysis/reference/light_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "paim/base/seed.h"

namespace paim {
namespace {

// A small map with black pixels, a bright one, and values below zero.
Image small_map() {
    Image image(6, 3);
    RandomStream random(5);
    for (Vec3f& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<float>(random.uniform());
    }
    image.at(2, 1) = Vec3f(30.0f, 1.0f, 2.0f);
    image.at(3, 1) = Vec3f::Zero();
    image.at(0, 0) = Vec3f::Zero();
    image.at(5, 2) = Vec3f(-0.01f, 0.2f, 0.1f);
    return image;
}

double solid_angle(const Image& image, int y) {
    return 2.0 * kPi / image.width *
           (std::cos(kPi * y / image.height) - std::cos(kPi * (y + 1) / image.height));
}

TEST(LightSampler, DensityIsThatOfTheLargestChannel) {
    const Image image = small_map();
    const LightSampler sampler{EnvironmentLight(image)};
    double total = 0.0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            total +=
                solid_angle(image, y) * static_cast<double>(image.at(x, y).cwiseAbs().maxCoeff());
        }
    }
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3d direction =
                direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / image.height);
            const LightSampler::Sample seen = sampler.look(direction.cast<float>());
            EXPECT_EQ(seen.radiance, image.at(x, y)) << x << ' ' << y;
            const double expected =
                static_cast<double>(image.at(x, y).cwiseAbs().maxCoeff()) / total;
            // A float of sums in double.
            EXPECT_NEAR(static_cast<double>(seen.density), expected, 1e-7 * expected);
        }
    }
}

// Counts of 60,000 samples a pixel against their probabilities; every sample is seen where it is.
TEST(LightSampler, SamplesPixelsByTheirLight) {
    const Image image = small_map();
    const LightSampler sampler{EnvironmentLight(image)};
    constexpr int kSamples = 60'000;
    RandomStream random(11);
    std::map<std::pair<int, int>, int> counts;
    for (int j = 0; j < kSamples; ++j) {
        const double u = random.uniform(), v = random.uniform();
        const LightSampler::Sample sample = sampler.sample(u, v);
        EXPECT_NEAR(static_cast<double>(sample.direction.norm()), 1.0, 1e-6);
        const auto [s, t] = latlong_from_direction(sample.direction.cast<double>());
        ++counts[{static_cast<int>(s * image.width), static_cast<int>(t * image.height)}];
    }
    double squares = 0.0;
    int pixels = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const Vec3d direction =
                direction_from_latlong((x + 0.5) / image.width, (y + 0.5) / image.height);
            const double share = solid_angle(image, y) *
                                 static_cast<double>(sampler.look(direction.cast<float>()).density);
            const int count = counts[{x, y}];
            if (share == 0.0) {
                EXPECT_EQ(count, 0) << x << ' ' << y;
                continue;
            }
            const double expected = share * kSamples;
            squares += (count - expected) * (count - expected) / expected;
            ++pixels;
        }
    }
    EXPECT_EQ(pixels, 16);
    // χ² of 15 degrees of freedom: above 37.7 in one of a thousand runs; the seed is fixed.
    EXPECT_LT(squares, 37.7);
}

// Within a pixel, directions are uniform in solid angle: the mean height over the top row of a white
// map is that of a cap.
TEST(LightSampler, IsUniformWithinAPixel) {
    Image image(4, 2);
    image.at(0, 0) = image.at(1, 0) = image.at(2, 0) = image.at(3, 0) = Vec3f::Ones();
    const LightSampler sampler{EnvironmentLight(image)};
    double height = 0.0;
    constexpr int kSamples = 4096;
    for (int j = 0; j < kSamples; ++j) {
        height += static_cast<double>(sampler.sample(0.3, (j + 0.5) / kSamples).direction.y());
    }
    // Uniform in the sine of the latitude, 0 … 1; a midpoint rule.
    EXPECT_NEAR(height / kSamples, 0.5, 1e-6);
}

TEST(LightSampler, ABlackMapHasNoDirections) {
    const LightSampler sampler{EnvironmentLight(Image(4, 2))};
    EXPECT_TRUE(sampler.is_black());
    EXPECT_EQ(sampler.look(Vec3f::UnitY()).density, 0.0f);
    EXPECT_DEATH(sampler.sample(0.5, 0.5), "is_black");
}

// The last number below 1 and the first one find pixels that have light.
TEST(LightSampler, EndsOfTheIntervalArePixelsWithLight) {
    Image image(4, 3);
    image.at(2, 1) = Vec3f::Ones();
    const LightSampler sampler{EnvironmentLight(image)};
    for (const double u : {0.0, std::nextafter(1.0, 0.0)}) {
        EXPECT_EQ(sampler.sample(u, u).radiance, Vec3f::Ones()) << u;
    }
}

}  // namespace
}  // namespace paim
