// Smoothing within rounding: closed forms, what stays in its place, and the gain on a smooth plane.
#include "paim/codec/surface_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/grid_surface.h"

namespace paim {
namespace {

const Topology kTriangle{4, {{0, 1, 2}}};  // and a vertex of no face

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t j = 0; j < a.size(); ++j) sum += std::pow(double{a[j]} - double{b[j]}, 2.0);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(SurfaceSmoother, MovesHalfOfTheWayToTheMeanWithinReach) {
    const SurfaceSmoother smoother(kTriangle);
    const std::vector<float> stored{0.0f, 1.0f, 1.0f, 7.0f};
    std::vector<float> values = stored;
    smoother.smooth(stored, 1, 0.4375f, values);
    // Means of neighbours: 1, 1/2, 1/2.
    EXPECT_EQ(values, (std::vector<float>{0.4375f, 0.75f, 0.75f, 7.0f}));
    smoother.smooth(stored, 1, 0.4375f, values);
    EXPECT_EQ(values, (std::vector<float>{0.4375f, 0.671875f, 0.671875f, 7.0f}));
    std::vector<float> at_once = stored;
    smoother.smooth(stored, 2, 0.4375f, at_once);
    EXPECT_EQ(at_once, values);
}

// The error of rounding is 1 / √12 of a step. A quarter of it is left where 20 values share one
// integer.
TEST(SurfaceSmoother, LeavesLittleErrorOnASmoothSurface) {
    constexpr uint32_t kWidth = 60;
    const std::vector<float> exact = paraboloid(kWidth);
    std::vector<float> stored = exact;
    for (float& value : stored) value = std::nearbyint(value);
    EXPECT_NEAR(rms_difference(stored, exact), 1.0 / std::sqrt(12.0), 0.03);
    std::vector<float> values = stored;
    SurfaceSmoother(make_grid(kWidth)).smooth(stored, kMaxSmoothingRounds, 0.4375f, values);
    EXPECT_LT(rms_difference(values, exact), 0.6 / std::sqrt(12.0));
}

LowRank make_matrix(std::vector<int16_t> mean, uint32_t fraction_bits, uint32_t rounds) {
    LowRank matrix;
    matrix.num_points = 4;
    matrix.num_planes = 1;
    matrix.num_poses = 1;
    matrix.mean = std::move(mean);
    matrix.steps = {0.5f};
    matrix.fraction_bits = fraction_bits;
    matrix.smoothing = {rounds};
    return matrix;
}

TEST(SmoothStored, ScalesIntegersAndSteps) {
    LowRank matrix = make_matrix({0, 1, 1, -7}, 4, 1);
    smooth_stored(matrix, kTriangle);
    EXPECT_EQ(matrix.mean, StoredValues(std::vector<int16_t>{7, 12, 12, -112}));
    EXPECT_EQ(matrix.steps, std::vector<float>{0.5f / 16.0f});
    EXPECT_EQ(stored_integers(matrix.mean, 4), StoredValues(std::vector<int8_t>{0, 1, 1, -7}));

    LowRank plain = make_matrix({0, 1, 1, -7}, 0, 1);
    smooth_stored(plain, kTriangle);
    EXPECT_EQ(plain.mean, StoredValues(std::vector<int16_t>{0, 1, 1, -7}));
}

TEST(SmoothStored, NeverLeavesTheIntegersThatWereStored) {
    constexpr uint32_t kWidth = 20;
    for (const uint32_t bits : {2u, 3u, 4u}) {
        LowRank matrix;
        matrix.num_points = kWidth * kWidth;
        matrix.num_planes = 1;
        matrix.num_poses = 1;
        std::vector<int16_t> integers;
        for (uint32_t v = 0; v < matrix.num_points; ++v) {
            integers.push_back(static_cast<int16_t>(static_cast<int>(v * 977 % 4001) - 2000));
        }
        matrix.mean = integers;
        matrix.steps = {1.0f};
        matrix.fraction_bits = bits;
        matrix.smoothing = {8};
        smooth_stored(matrix, make_grid(kWidth));
        EXPECT_EQ(stored_integers(matrix.mean, bits), StoredValues(integers)) << bits;
    }
}

TEST(SmoothingFractionBits, LeaveRoomInSixteenBits) {
    const auto bits = [](int16_t largest) {
        return smoothing_fraction_bits(make_matrix({0, 0, 0, largest}, 0, 0));
    };
    EXPECT_EQ(bits(100), 4u);
    EXPECT_EQ(bits(2047), 4u);
    EXPECT_EQ(bits(-2048), 3u);
    EXPECT_EQ(bits(4096), 2u);
    EXPECT_EQ(bits(8191), 2u);
    EXPECT_EQ(bits(8192), 0u);
}

}  // namespace
}  // namespace paim
