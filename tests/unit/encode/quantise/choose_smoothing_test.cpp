// How often planes are smoothed: where it helps, and never where it does not.
#include "compressor/encode/quantise/choose_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/codec/surface_smoothing.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

constexpr uint32_t kWidth = 50;

// The same paraboloid as x, y and z, and a component of random numbers.
ScaledFactors make_factors() {
    ScaledFactors factors;
    factors.num_points = kWidth * kWidth;
    factors.num_planes = 3;
    for (uint32_t plane = 0; plane < 3; ++plane) {
        const std::vector<float> heights = paraboloid(kWidth);
        factors.mean.insert(factors.mean.end(), heights.begin(), heights.end());
    }
    factors.components.emplace_back();
    for (size_t row = 0; row < factors.mean.size(); ++row) {
        factors.components[0].push_back(static_cast<float>(mix_bits(row) % 1000) * 1e-2f - 5.0f);
    }
    factors.weights = Eigen::RowVector2d(1.0, -1.0);
    factors.singular_values = {1.0};
    return factors;
}

double squared_error(const std::vector<float>& exact, const LowRank& matrix,
                     const StoredValues& values, uint32_t plane) {
    double sum = 0.0;
    values.for_each(size_t{plane} * matrix.num_points, matrix.num_points, [&](size_t row, float q) {
        sum += std::pow(double{matrix.steps[plane]} * double{q} - double{exact[row]}, 2.0);
    });
    return sum;
}

TEST(SmoothQuantised, HelpsSmoothPlanesAndLeavesOthersAlone) {
    const ScaledFactors factors = make_factors();
    const Quantiser quantiser{1.0, 1, {1.0, 1.0, 1.0}};
    const LowRank plain = quantise(factors, quantiser);
    LowRank after = plain;
    smooth_quantised(factors, SurfaceSmoother(make_grid(kWidth)), after);
    ASSERT_EQ(plain.num_components, 1u);
    ASSERT_EQ(after.fraction_bits, 4u);
    ASSERT_EQ(after.smoothing.size(), 6u);
    for (uint32_t plane = 0; plane < 3; ++plane) {
        EXPECT_EQ(after.smoothing[plane], kMaxSmoothingRounds);
        EXPECT_LT(squared_error(factors.mean, after, after.mean, plane),
                  0.5 * squared_error(factors.mean, plain, plain.mean, plane));
        EXPECT_EQ(after.smoothing[3 + plane], 0u);
        EXPECT_EQ(squared_error(factors.components[0], after, after.components[0], plane),
                  squared_error(factors.components[0], plain, plain.components[0], plane));
    }
    EXPECT_EQ(after.weights, plain.weights);
}

TEST(SmoothQuantised, LeavesWhatDoesNotGainAsItIs) {
    ScaledFactors factors = make_factors();
    factors.mean = factors.components[0];
    const Quantiser quantiser{1.0, 1, {1.0, 1.0, 1.0}};
    const LowRank plain = quantise(factors, quantiser);
    LowRank same = plain;
    smooth_quantised(factors, SurfaceSmoother(make_grid(kWidth)), same);
    EXPECT_EQ(same, plain);
    // Values that fill their 16 bits leave no room for fractions.
    Quantiser fine = quantiser;
    fine.step = 1.01 * smallest_step(factors, quantiser, Precision::i16);
    const LowRank wide = quantise(factors, fine);
    same = wide;
    smooth_quantised(factors, SurfaceSmoother(make_grid(kWidth)), same);
    EXPECT_EQ(same, wide);
}

}  // namespace
}  // namespace paim
