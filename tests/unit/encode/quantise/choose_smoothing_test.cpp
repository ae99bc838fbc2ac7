// How often planes are smoothed: where it helps, and never where it does not.
#include "compressor/encode/quantise/choose_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/codec/rebuild_planes.h"
#include "poses/octopus.h"

namespace paim {
namespace {

// The positions of the octopus in one pose, and a component of random numbers.
ScaledFactors make_factors(const Topology& topology, const std::vector<Vec3f>& positions) {
    ScaledFactors factors;
    factors.num_points = topology.num_vertices;
    factors.num_planes = 3;
    factors.mean.resize(3 * positions.size());
    factors.components.assign(1, factors.mean);
    for (size_t v = 0; v < positions.size(); ++v) {
        for (size_t axis = 0; axis < 3; ++axis) {
            const size_t row = axis * positions.size() + v;
            factors.mean[row] = positions[v][static_cast<Eigen::Index>(axis)];
            factors.components[0][row] = static_cast<float>(mix_bits(row) % 1000) * 1e-3f - 0.5f;
        }
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
    const PoseSet octopus = poses::make_octopus(4000, 1);
    const Topology& topology = octopus.topology();
    const ScaledFactors factors = make_factors(topology, octopus.load_pose(0).positions);
    const Quantiser quantiser{0.02, 1, {1.0, 1.0, 1.0}};
    const LowRank plain = quantise(factors, quantiser);
    LowRank after = plain;
    smooth_quantised(factors, topology, after);
    ASSERT_EQ(plain.num_components, 1u);
    ASSERT_EQ(after.fraction_bits, 4u);
    ASSERT_EQ(after.smoothing.size(), 6u);
    for (uint32_t plane = 0; plane < 3; ++plane) {
        EXPECT_GT(after.smoothing[plane], 0u);
        EXPECT_LT(squared_error(factors.mean, after, after.mean, plane),
                  0.6 * squared_error(factors.mean, plain, plain.mean, plane));
        EXPECT_EQ(after.smoothing[3 + plane], 0u);
        EXPECT_NEAR(squared_error(factors.components[0], after, after.components[0], plane),
                    squared_error(factors.components[0], plain, plain.components[0], plane), 1e-9);
    }
    EXPECT_EQ(after.weights, plain.weights);
}

TEST(SmoothQuantised, LeavesWhatDoesNotGainAsItIs) {
    const PoseSet octopus = poses::make_octopus(500, 1);
    ScaledFactors factors = make_factors(octopus.topology(), octopus.load_pose(0).positions);
    factors.mean = factors.components[0];
    const Quantiser quantiser{0.05, 1, {1.0, 1.0, 1.0}};
    const LowRank plain = quantise(factors, quantiser);
    LowRank same = plain;
    smooth_quantised(factors, octopus.topology(), same);
    EXPECT_EQ(same, plain);
    // Values that fill their 16 bits leave no room for fractions.
    Quantiser fine = quantiser;
    fine.step = 1.01 * smallest_step(factors, quantiser, Precision::i16);
    const LowRank wide = quantise(factors, fine);
    same = wide;
    smooth_quantised(factors, octopus.topology(), same);
    EXPECT_EQ(same, wide);
}

}  // namespace
}  // namespace paim
