// Exposures of vertices and lights that are known.
#include "player/light/auto_exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "player/light/key_light.h"

namespace paim::player {
namespace {

float exposure_of(const std::vector<std::vector<Vec3f>>& parts) {
    const std::vector<std::span<const Vec3f>> spans(parts.begin(), parts.end());
    return auto_exposure_ev(spans);
}

TEST(AutoExposure, KeepsNearlyAllVerticesBelowWhite) {
    std::vector<Vec3f> vertices(100, Vec3f(1.0f, 4.0f, 2.0f));
    EXPECT_FLOAT_EQ(exposure_of({vertices}), -2.0f);
    vertices[7] = Vec3f::Constant(1000.0f);  // one highlight of a hundred
    EXPECT_FLOAT_EQ(exposure_of({vertices}), -2.0f);
    for (size_t i = 0; i < 10; ++i) vertices[i] = Vec3f::Constant(32.0f);
    EXPECT_FLOAT_EQ(exposure_of({vertices}), -5.0f);
}

TEST(AutoExposure, LeavesOutWhatIsBlackOrNotFinite) {
    EXPECT_EQ(exposure_of({}), 0.0f);
    EXPECT_EQ(exposure_of({{}, {}}), 0.0f);
    std::vector<Vec3f> vertices(1000, Vec3f::Zero());
    EXPECT_EQ(exposure_of({vertices}), 0.0f);
    vertices[3] = Vec3f::Constant(0.125f);
    vertices[4] = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());
    vertices[5] = Vec3f::Constant(std::numeric_limits<float>::infinity());
    EXPECT_FLOAT_EQ(exposure_of({vertices}), 3.0f);
}

TEST(AutoExposure, StaysInTheRangeOfTheOption) {
    EXPECT_EQ(exposure_of({{Vec3f::Constant(1e-30f)}}), 30.0f);
    EXPECT_EQ(exposure_of({{Vec3f::Constant(1e30f)}}), -30.0f);
}

TEST(AutoExposure, LooksAtAllParts) {
    const std::vector<Vec3f> dark(10, Vec3f::Constant(0.5f)), bright(10, Vec3f::Constant(8.0f));
    EXPECT_FLOAT_EQ(exposure_of({dark}), 1.0f);
    EXPECT_FLOAT_EQ(exposure_of({dark, bright}), -3.0f);
    EXPECT_FLOAT_EQ(exposure_of({bright, dark}), -3.0f);
}

// Of 500,000 vertices every eighth is looked at, wherever parts begin.
TEST(AutoExposure, LooksAtAShareOfManyVertices) {
    std::vector<Vec3f> vertices;
    for (int i = 0; i < 500000; ++i) {
        vertices.push_back(Vec3f::Constant(std::exp2(static_cast<float>(i % 8))));
    }
    EXPECT_EQ(exposure_of({vertices}), 0.0f);
    const std::vector<Vec3f> first(vertices.begin(), vertices.begin() + 333333);
    const std::vector<Vec3f> second(vertices.begin() + 333333, vertices.end());
    EXPECT_EQ(exposure_of({first, second}), 0.0f);
    // Few enough to look at all.
    vertices.resize(65536);
    EXPECT_EQ(exposure_of({vertices}), -7.0f);
}

TEST(AutoExposure, OfALightIsThatOfWhiteSurfaces) {
    // Constant radiance c has L_0 = sqrt(4π) c, and white surfaces show c.
    const auto l0 = static_cast<float>(std::sqrt(4.0 * kPi) * 4.0);
    EXPECT_NEAR(auto_exposure_ev(LightCoefficients{1, {Vec3f::Constant(l0)}}), -2.0f, 1e-5f);
    EXPECT_EQ(auto_exposure_ev(LightCoefficients{1, {Vec3f::Zero()}}), 0.0f);
    // A surface that faces a light of irradiance 8 π shows 8. Three bands exaggerate it by 1/16
    // at most, and 98 % of the lit ones have a cosine of 0.98 or less.
    KeyLight key;
    key.strength = 8.0 * kPi;
    EXPECT_NEAR(auto_exposure_ev(key.coefficients(3)), -3.0f, 0.1f);
}

}  // namespace
}  // namespace paim::player
