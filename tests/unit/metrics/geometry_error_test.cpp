// Errors of positions, on numbers small enough to work out by hand.
#include "paim/metrics/geometry_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace paim {
namespace {

// Two vertices, two poses: a diagonal of 2, then of √(3² + 4²).
GeometryError by_hand() {
    GeometryError error;
    error.add(std::vector<float>{0, 2, 0, 0, 0, 0}, std::vector<float>{0, 2, 0, 0, 0, 0}, 0);
    error.add(std::vector<float>{10, 14, 20, 24, 30, 30},
              std::vector<float>{10, 13, 20, 24, 30, 28}, 1);
    return error;
}

TEST(GeometryError, ByHand) {
    const GeometryError error = by_hand();
    // Only the second vertex of the second pose is off, by (1, 0, 2).
    const double squared = 5.0;
    EXPECT_NEAR(error.diagonal, std::sqrt(9.0 + 16.0 + 4.0), 1e-15);
    EXPECT_NEAR(error.rms(), std::sqrt(squared / 4.0), 1e-15);
    EXPECT_NEAR(error.worst(), std::sqrt(squared), 1e-15);
    EXPECT_EQ(error.distance.worst_vertex, 1u);
    EXPECT_EQ(error.distance.worst_pose, 1u);
    EXPECT_NEAR(error.relative_rms(), std::sqrt(squared / 4.0 / 29.0), 1e-15);
    EXPECT_NEAR(error.relative_worst(), std::sqrt(squared / 29.0), 1e-15);
    // From their means both vertices of a pose are half a diagonal away: 2 · 1² and 2 · 29/4.
    EXPECT_NEAR(error.kg_error(), 100.0 * std::sqrt(squared / (2.0 + 14.5)), 1e-12);
    // 1000 ‖A − A'‖_F / √(3 · 2 · 2), scaled to a diagonal of 2.
    EXPECT_NEAR(error.e_rms(), 1000.0 * std::sqrt(squared / 12.0) * 2.0 / std::sqrt(29.0), 1e-11);
}

// Karni and Gotsman's error does not know where the mesh is; nothing but distances knows how large.
TEST(GeometryError, RelativeFiguresDoNotDependOnPlaceOrSize) {
    const std::vector<float> a{0, 2, 1, 3, 5, 4}, b{0, 2, 1, 3, 4, 4};
    std::vector<float> a2 = a, b2 = b;
    // Exact in floats.
    for (float& x : a2) x = 4.0f * x + 64.0f;
    for (float& x : b2) x = 4.0f * x + 64.0f;
    GeometryError near_one, far_one;
    near_one.add(a, b, 0);
    far_one.add(a2, b2, 0);
    EXPECT_NEAR(far_one.rms(), 4.0 * near_one.rms(), 1e-15);
    EXPECT_NEAR(far_one.relative_rms(), near_one.relative_rms(), 1e-15);
    EXPECT_NEAR(far_one.kg_error(), near_one.kg_error(), 1e-12);
    EXPECT_NEAR(far_one.e_rms(), near_one.e_rms(), 1e-12);
}

TEST(GeometryError, OfPointsIsNothingOrInfinite) {
    GeometryError error;
    error.add({}, {}, 0);
    for (const double nothing : {error.rms(), error.worst(), error.relative_rms(),
                                 error.relative_worst(), error.kg_error(), error.e_rms()}) {
        EXPECT_TRUE(std::isnan(nothing));
    }
    error.add(std::vector<float>{1, 2, 3}, std::vector<float>{1, 2, 3}, 1);
    EXPECT_EQ(error.relative_rms(), 0.0);
    EXPECT_EQ(error.relative_worst(), 0.0);
    EXPECT_EQ(error.kg_error(), 0.0);
    EXPECT_EQ(error.e_rms(), 0.0);
    error.add(std::vector<float>{1, 2, 4}, std::vector<float>{1, 2, 3}, 2);
    EXPECT_TRUE(std::isinf(error.relative_rms()));
    EXPECT_TRUE(std::isinf(error.relative_worst()));
    EXPECT_TRUE(std::isinf(error.kg_error()));
    EXPECT_TRUE(std::isinf(error.e_rms()));
}

TEST(GeometryError, OfNumbersThatAreNoneIsNone) {
    GeometryError error;
    const float none = std::numeric_limits<float>::quiet_NaN();
    error.add(std::vector<float>{1, none, 3, 0, 0, 0}, std::vector<float>{1, 2, 3, 0, 0, 0}, 0);
    EXPECT_TRUE(std::isnan(error.rms()));
    EXPECT_TRUE(std::isnan(error.worst()));
    EXPECT_TRUE(std::isnan(error.kg_error()));
    EXPECT_EQ(error.distance.worst_vertex, 1u);
}

TEST(GeometryErrorDeathTest, RefusesArraysThatDoNotMatch) {
    GeometryError error;
    EXPECT_DEATH(error.add(std::vector<float>(6), std::vector<float>(3), 0), "got 6 and 3");
    EXPECT_DEATH(error.add(std::vector<float>(4), std::vector<float>(4), 0), "got 1 and 0");
}

}  // namespace
}  // namespace paim
