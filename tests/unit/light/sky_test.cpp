// The built-in sky: finite, as bright as promised at any size, blue above, warm where the sun is.
#include "paim/light/sky.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/tbb_parallel.h"
#include "paim/light/environment.h"

namespace paim {
namespace {

Vec3d average(const Image& sky) {
    return project_latlong(sky, 1).values[0].cast<double>() / std::sqrt(4.0 * kPi);
}

TEST(Sky, IsALightOfTheSameAverageAtAnySize) {
    const Vec3d expected = average(make_sky());
    EXPECT_GT(expected.minCoeff(), 0.3);
    EXPECT_LT(expected.maxCoeff(), 0.6);
    for (const int height : {2, 3, 16, 100, 700}) {
        const EnvironmentLight light(make_sky(height));
        ASSERT_EQ(light.image().height, height);
        ASSERT_EQ(light.image().width, 2 * height);
        // Samples a third of a degree apart see a disc of 6° diameter with an error of its rim's
        // share, random in sign: well below 2 %.
        EXPECT_LT((average(light.image()) - expected).norm(), 0.02 * expected.norm()) << height;
    }
}

TEST(Sky, HasBlueAboveAWarmSunAndADimGround) {
    const EnvironmentLight light(make_sky(256));
    const Vec3f zenith = light.radiance(Vec3d::UnitY());
    EXPECT_GT(zenith.z(), 2.0f * zenith.x());
    const double elevation = 28.0 * kPi / 180.0;
    const double azimuth = -50.0 * kPi / 180.0;
    const Vec3d sun(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                    std::cos(azimuth) * std::cos(elevation));
    const Vec3f disc = light.radiance(sun);
    EXPECT_GT(disc.minCoeff(), 100.0f);
    EXPECT_GT(disc.x(), 1.5f * disc.z());
    for (const Vec3f& pixel : light.image().pixels) {
        ASSERT_GT(pixel.minCoeff(), 0.0f);
        ASSERT_LE(pixel.x(), disc.x() * 1.01f);
    }
    const Vec3f ground = light.radiance(-Vec3d::UnitY());
    EXPECT_LT(ground.maxCoeff(), 0.3f);
}

TEST(Sky, DoesNotDependOnThreads) {
    const auto make = [](int num_threads) {
        const ThreadLimit limit(num_threads);
        return make_sky(64).pixels;
    };
    EXPECT_EQ(make(1), make(2));
}

TEST(SkyDeathTest, RefusesOtherSizes) {
    EXPECT_DEATH(make_sky(1), "check failed");
    EXPECT_DEATH(make_sky(4097), "check failed");
}

}  // namespace
}  // namespace paim
