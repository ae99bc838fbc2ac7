// Outliers as components of their own.
#include "compressor/encode/quantise/exceptions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compressor/encode/quantise/choose_smoothing.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/metrics/singular_value_error.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

constexpr uint32_t kGridWidth = 12, kGridPoses = 6;

// A paraboloid whose third coordinate moves.
ScaledFactors moving_grid() {
    ScaledFactors factors;
    factors.num_points = kGridWidth * kGridWidth;
    factors.num_planes = 3;
    const std::vector<float> heights = paraboloid(kGridWidth);
    factors.components.resize(1);
    for (uint32_t axis = 0; axis < 3; ++axis) {
        factors.mean.insert(factors.mean.end(), heights.begin(), heights.end());
        for (const float height : heights) {
            factors.components[0].push_back(axis == 2 ? 0.3f * height : 0.0f);
        }
    }
    factors.weights.resize(1, kGridPoses);
    factors.weights << 1, -1, 1, -1, 1, -1;
    factors.singular_values = {10.0, 2.0};
    return factors;
}

PositionOutliers some_outliers(float far) {
    return PositionOutliers({{7, 2, {far, -0.5f * far, 3}, {1, 2, 3}},
                             {100, 2, {0, 1, 0.1f * far}, {4, 5, 6}},
                             {7, 5, {1, 2, -far}, {1, 2, 3}}});
}

// Every position that is no outlier is the same to the bit, and the outliers are differences.
void expect_exceptions(const LowRank& without, const LowRank& with,
                       const PositionOutliers& outliers, double tolerance) {
    EXPECT_EQ(with.num_usual_components(), without.num_components);
    EXPECT_EQ(without.num_usual_components(), without.num_components);
    EXPECT_EQ(with.components.size(), size_t{with.num_components});
    EXPECT_EQ(with.weights.size(), size_t{with.num_components} * kGridPoses);
    EXPECT_LE(with.num_components, without.num_components + kExceptionsPerPose * 2);
    EXPECT_GE(with.num_components, without.num_components + 2);
    EXPECT_EQ(energy_error(with), energy_error(without));
    PositionDecoder decoder;
    std::vector<float> expected, decoded;
    for (uint32_t p = 0; p < kGridPoses; ++p) {
        decoder.decode(without, p, without.num_components, expected);
        decoder.decode(with, p, with.num_components, decoded);
        for (const PositionOutlier& one : outliers.of_pose(p)) {
            Vec3d error;
            for (size_t axis = 0; axis < 3; ++axis) {
                const size_t row = axis * without.num_points + one.vertex;
                const auto a = static_cast<int>(axis);
                error[a] = double{decoded[row]} - double{expected[row]} - double{one.position[a]} +
                           double{one.usual[a]};
                decoded[row] = expected[row];
            }
            EXPECT_LT(error.norm(), tolerance) << p;
        }
        EXPECT_EQ(decoded, expected) << p;
    }
}

TEST(Exceptions, OfFloatsAreExact) {
    const ScaledFactors factors = moving_grid();
    for (const uint32_t num_components : {1u, 0u}) {
        for (const float far : {50.0f, 1e30f}) {
            const LowRank without = float_matrix(factors, num_components, Precision::f32);
            LowRank with = without;
            append_exceptions(some_outliers(far), with);
            EXPECT_EQ(with.num_components, without.num_components + 2);
            // Three roundings of floats, of 2^-24 each.
            expect_exceptions(without, with, some_outliers(far), 4.0 * 0x1p-24 * double{far});
        }
    }
}

TEST(Exceptions, OfHalfFloatsErrByTheirDigits) {
    const LowRank without = float_matrix(moving_grid(), 1, Precision::f16);
    LowRank with = without;
    append_exceptions(some_outliers(5000.0f), with);
    // Half floats have 11 digits; three coordinates.
    expect_exceptions(without, with, some_outliers(5000.0f), 5000.0 * 0x1p-11);
}

TEST(Exceptions, OfIntegersErrByTheirStep) {
    const ScaledFactors factors = moving_grid();
    const Topology grid = make_grid(kGridWidth);
    const double step = 0.4;  // coarser than the grid is curved, so that smoothing helps
    const Quantiser quantiser{step, 1, {1.0, 1.0, 1.0}};
    const LowRank plain = quantise(factors, quantiser);
    const LowRank smooth = smoothed(factors, quantiser, SurfaceSmoother(grid));
    EXPECT_GT(smooth.fraction_bits, 0u);
    for (const LowRank& without : {plain, smooth}) {
        for (const float far : {20.0f, 5000.0f, 1e30f}) {
            LowRank with = without;
            append_exceptions(some_outliers(far), with);
            // Half a step in three coordinates, or what floats and two integers leave.
            expect_exceptions(without, with, some_outliers(far),
                              std::max(step, 1e-6 * double{far}));
        }
    }
}

TEST(Exceptions, AreNotThereWithoutOutliers) {
    const LowRank without = float_matrix(moving_grid(), 1, Precision::f32);
    LowRank with = without;
    append_exceptions({}, with);
    EXPECT_TRUE(with == without);
}

}  // namespace
}  // namespace paim
