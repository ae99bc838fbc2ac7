// Turning a light: against the same map with its columns shifted, which pins down the sign.
#include "paim/light/light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/light/environment.h"
#include "paim/sh/basis_reference.h"

namespace paim {
namespace {

// Radiance that the coefficients give in a direction, first channel.
double value_at(const LightCoefficients& light, const Vec3d& direction) {
    double sum = 0.0;
    for (size_t i = 0; i < light.values.size(); ++i) {
        const int l = sh::band_of(static_cast<int>(i));
        sum += light.values[i].x() *
               sh::basis_reference(l, static_cast<int>(i) - sh::index(l, 0), direction);
    }
    return sum;
}

TEST(TurnAboutY, AQuarterTurnMovesTheSunFromZToX) {
    Image image(64, 32);
    for (const int y : {15, 16}) {
        for (const int x : {31, 32}) image.at(x, y) = Vec3f(1, 1, 1);
    }
    const LightCoefficients light = project_latlong(image, 5);
    const LightCoefficients turned = turn_about_y(light, kPi / 2.0);
    // Four pixels round +Z are symmetric about it, so that values at the axes go over into one
    // another to float rounding; the peak is about 0.04 · 25/4π = 0.08.
    EXPECT_GT(value_at(light, Vec3d::UnitZ()), 0.05);
    EXPECT_NEAR(value_at(turned, Vec3d::UnitX()), value_at(light, Vec3d::UnitZ()), 1e-6);
    EXPECT_NEAR(value_at(turned, Vec3d::UnitZ()), value_at(light, -Vec3d::UnitX()), 1e-6);
    EXPECT_NEAR(value_at(turned, -Vec3d::UnitX()), value_at(light, -Vec3d::UnitZ()), 1e-6);
    EXPECT_NEAR(value_at(turned, Vec3d::UnitY()), value_at(light, Vec3d::UnitY()), 1e-6);
}

TEST(TurnAboutY, IsShiftingTheColumns) {
    RandomStream random(stream_key(31, 0, 0));
    Image image(36, 18);
    for (Vec3f& pixel : image.pixels) {
        for (float& value : pixel) value = static_cast<float>(random.uniform());
    }
    const LightCoefficients light = project_latlong(image, 7);
    for (const int columns : {1, 5, 35, -4}) {
        // Longitude falls by 10° a column, so that a turn by +10° moves every column one to the
        // left.
        Image shifted(36, 18);
        for (int y = 0; y < 18; ++y) {
            for (int x = 0; x < 36; ++x) {
                shifted.at((x - columns + 72) % 36, y) = image.at(x, y);
            }
        }
        const LightCoefficients expected = project_latlong(shifted, 7);
        const LightCoefficients turned = turn_about_y(light, columns * kPi / 18.0);
        ASSERT_EQ(turned.bands, 7);
        for (size_t i = 0; i < 49; ++i) {
            // Roundings of values up to 2 to float, before and after.
            EXPECT_LT((turned.values[i] - expected.values[i]).norm(), 2e-6f) << i;
        }
    }
}

TEST(TurnAboutYDeathTest, RefusesWrongSizes) {
    EXPECT_DEATH(turn_about_y(LightCoefficients{2, std::vector<Vec3f>(3)}, 1.0), "check failed");
}

}  // namespace
}  // namespace paim
