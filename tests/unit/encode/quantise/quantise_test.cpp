// Quantised components against what they decode to, against closed forms, and at their limits.
#include "compressor/encode/quantise/quantise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "paim/base/error.h"
#include "tests/unit/encode/quantise/random_factors.h"

namespace paim {
namespace {

using Eigen::Index;

constexpr uint32_t kAll = 1000;  // more components than there are

std::vector<double> alike(const ScaledFactors& factors) {
    return std::vector<double>(factors.num_planes, 1.0);
}

double decoded(const ScaledFactors& factors, const Quantiser& quantiser) {
    const CodedMesh mesh = mesh_of(SvdTransfer(quantise(factors, quantiser)), factors.num_points);
    return decoded_error(mesh, factors, quantiser.plane_weight);
}

TEST(Quantise, ErrorIsThatOfWhatIsDecoded) {
    const ScaledFactors factors = random_factors();
    const std::vector<double> weights{1.0, 4.0, 0.25, 0.01};
    for (const double step : {0.3, 0.05, 0.004}) {
        for (const uint32_t kept : {0u, 2u, kAll}) {
            const Quantiser quantiser{step, kept, weights};
            const double stated = quantised_error(factors, quantiser);
            const double found = decoded(factors, quantiser);
            // Weights are least squares, so that rounding them only adds: P weights of a component
            // cost what P of its 1600 values do, 0.75 % of P step²/12 each on average. Floats:
            // 2^-24 of values near 1 is much smaller than a step.
            EXPECT_GE(found, 0.99999 * stated) << step << " " << kept;
            EXPECT_LE(found, 1.03 * stated) << step << " " << kept;
        }
    }
}

TEST(Quantise, FineStepsCostATwelfthOfTheirSquare) {
    const ScaledFactors factors = random_factors({5000, 4, 12, {1.0, 1.0, 1.0}});
    const double step = 1e-3;
    const double values = 4.0 * 20000.0;
    const double error = quantised_error(factors, {step, kAll, alike(factors)});
    // The square of a uniform error has a relative deviation of √0.8: 0.3 % of 80000, five times
    // that. The dead zone moves one value of 10000 by at most 0.1 step.
    EXPECT_NEAR(error / (12.0 * values * step * step / 12.0), 1.0, 0.016);
}

TEST(Quantise, StepsOfPlanesWeighAlike) {
    const ScaledFactors factors = random_factors();
    const std::vector<double> weights{1.0, 4.0, 0.25, 0.01};
    const Quantiser quantiser{0.01, kAll, weights};
    const LowRank matrix = quantise(factors, quantiser);
    const std::vector<float> expected{0.01f, 0.005f, 0.02f, 0.1f};
    ASSERT_EQ(matrix.steps.size(), 4u);
    for (uint32_t j = 0; j < 4; ++j) EXPECT_FLOAT_EQ(matrix.steps[j], expected[j]);
    // So that each plane has about as much of the error: 1600 squares, deviation 2.3 %.
    const CodedMesh mesh = mesh_of(SvdTransfer(matrix), factors.num_points);
    const double share = quantised_error(factors, quantiser) / 4.0;
    for (uint32_t j = 0; j < 4; ++j) {
        std::vector<double> one(4, 0.0);
        one[j] = weights[j];
        EXPECT_NEAR(decoded_error(mesh, factors, one) / share, 1.0, 0.15) << j;
    }
}

TEST(Quantise, ComponentsWeakerThanTheStepVanish) {
    const ScaledFactors factors = random_factors({400, 4, 12, {1.0, 0.059, 0.02, 0.5}});
    const Quantiser quantiser{0.1, kAll, alike(factors)};
    const LowRank matrix = quantise(factors, quantiser);
    EXPECT_EQ(matrix.num_components, 2u);
    ASSERT_EQ(matrix.components.size(), 2u);
    EXPECT_EQ(matrix.weight_steps.size(), 2u);
    EXPECT_EQ(matrix.weights.size(), 2u * 12);
    EXPECT_NEAR(decoded(factors, quantiser) / quantised_error(factors, quantiser), 1.0, 0.02);
    EXPECT_EQ(quantise(factors, {10.0, kAll, alike(factors)}).num_components, 0u);
}

// A weight that costs as much as a value of its component would be zero in all poses.
TEST(Quantise, ComponentsWithoutWeightsAreDropped) {
    ScaledFactors factors = random_factors({400, 1, 64, {1.0, 1.0}});
    std::fill(factors.components[1].begin(), factors.components[1].end(), 0.0f);
    factors.components[1][7] = 0.1f;
    const LowRank matrix = quantise(factors, {0.1, kAll, alike(factors)});
    EXPECT_EQ(matrix.num_components, 1u);
}

TEST(Quantise, WeightsAreMultiplesOfStepsThatCostAsMuchAsAValue) {
    const ScaledFactors factors = random_factors();
    const LowRank matrix = quantise(factors, {0.02, kAll, alike(factors)});
    ASSERT_EQ(matrix.num_components, 3u);
    for (uint32_t k = 0; k < 3; ++k) {
        double squares = 0.0;
        matrix.components[k].for_each(0, matrix.num_rows(),
                                      [&](size_t, float q) { squares += double{q} * double{q}; });
        const float step = matrix.weight_steps[k];
        EXPECT_NEAR(double{step} * double{step} * squares / 12.0, 1.0, 1e-6);
        for (uint32_t p = 0; p < 12; ++p) {
            const float weight = matrix.weights[k * 12 + p];
            EXPECT_EQ(weight, std::nearbyint(weight / step) * step);
        }
    }
}

// Columns of integers that are sums of two others: what is left of a pivot is rounding.
TEST(Quantise, IntegersThatDependOnEachOtherHaveOrdinaryWeights) {
    for (uint32_t trial = 0; trial < 40; ++trial) {
        ScaledFactors factors = random_factors({300 + trial, 1, 12, {1.0, 1.0, 1.0, 1.0, 1.0}});
        RandomStream random(trial);
        const auto integer = [&](double count) { return std::floor(count * random.uniform()); };
        std::vector<double> a(5), b(5);
        for (double& x : a) x = 1.0 + integer(20.0);
        for (double& x : b) x = integer(9.0);
        for (size_t n = 0; n < factors.mean.size(); ++n) {
            const double x = integer(7.0) - 3.0;
            const double y = integer(5.0) - 2.0;
            for (size_t k = 0; k < 5; ++k) {
                factors.components[k][n] =
                    static_cast<float>(a[k] * x + b[k] * y + 0.9 * (random.uniform() - 0.5));
            }
        }
        const Quantiser quantiser{1.0, kAll, {1.0}};
        const LowRank matrix = quantise(factors, quantiser);
        ASSERT_EQ(matrix.num_components, 5u);
        for (const float weight : matrix.weights) {
            // The shares of five components, each at most √12 in a pose.
            EXPECT_LE(std::abs(weight), 40.0f) << trial;
        }
        // Rounding adds step²/12 · P for each of 5 · 12 weights, 60; five times that where they
        // round alike; and no more than a weight's whole step, 12 times that.
        const double rounding = decoded(factors, quantiser) - quantised_error(factors, quantiser);
        EXPECT_LE(rounding, 12.0 * 300.0) << trial;
    }
}

TEST(Quantise, LargestStepIsTheLargest) {
    const ScaledFactors factors = random_factors({2000, 4, 12, {1.0, 0.5, 0.25}});
    const Quantiser any{1.0, kAll, alike(factors)};
    const double all = quantised_error(factors, {100.0, kAll, alike(factors)});
    for (const double share : {1e-1, 1e-3, 1e-6}) {
        Quantiser found = any;
        found.step = largest_step(factors, any, share * all);
        EXPECT_LE(quantised_error(factors, found), share * all);
        // Errors of steps next to each other differ by 0.5 % as 32000 values happen to be rounded.
        found.step *= 1.03;
        EXPECT_GT(quantised_error(factors, found), share * all);
    }
}

TEST(Quantise, LargestStepKnowsItsLimits) {
    ScaledFactors factors = random_factors();
    const Quantiser any{1.0, kAll, alike(factors)};
    EXPECT_EQ(largest_step(factors, any, 0.0), 0.0);
    // Anything is good enough: the largest value is one step.
    EXPECT_NEAR(largest_step(factors, any, 1e9), 1.0, 1e-3);
    std::fill(factors.mean.begin(), factors.mean.end(), 0.0f);
    for (auto& component : factors.components) std::fill(component.begin(), component.end(), 0.0f);
    EXPECT_EQ(largest_step(factors, any, 0.0), 1.0);
    const LowRank nothing = quantise(factors, any);
    EXPECT_EQ(nothing.num_components, 0u);
    EXPECT_EQ(quantised_error(factors, any), 0.0);
}

TEST(Quantise, SmallestStepFitsItsBits) {
    const ScaledFactors factors = random_factors();
    for (const Precision precision : {Precision::i8, Precision::i16}) {
        Quantiser quantiser{1.0, kAll, {1.0, 4.0, 0.25, 0.01}};
        quantiser.step = smallest_step(factors, quantiser, precision);
        const LowRank matrix = quantise(factors, quantiser);
        float largest = 0.0f;
        for (size_t r = 0; r < matrix.num_rows(); ++r) {
            largest = std::max(largest, std::abs(matrix.mean[r]));
            for (const auto& component : matrix.components) {
                largest = std::max(largest, std::abs(component[r]));
            }
        }
        // Within 0.01 % of the largest.
        EXPECT_LE(largest, static_cast<float>(largest_integer(precision)));
        EXPECT_GE(largest, 0.9998f * static_cast<float>(largest_integer(precision)));
        EXPECT_EQ(matrix.mean.holds_i8(), precision == Precision::i8);
        if (precision == Precision::i8) continue;
        quantiser.step *= 0.999;
        try {
            quantise(factors, quantiser);
            FAIL() << "fits";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::unsupported);
        }
    }
}

// One plane and one component, without weights. With steps of 1, integers are the values.
ScaledFactors few_values(std::vector<float> mean, std::vector<float> component,
                         Eigen::Index poses) {
    ScaledFactors factors;
    factors.num_points = static_cast<uint32_t>(mean.size());
    factors.num_planes = 1;
    factors.mean = std::move(mean);
    factors.components = {std::move(component)};
    factors.singular_values = {1.0};
    factors.weights = Eigen::MatrixXd::Zero(1, poses);
    return factors;
}

// Values from −127 to 127 are stored in 8 bits, to ±32767 in 16, and larger ones are refused: the
// types hold −128 and −32768 as well, but ranges are symmetric.
TEST(Quantise, TakesTheFewestBitsThatHoldEveryValue) {
    const Quantiser quantiser{1.0, kAll, {1.0}};
    for (const float sign : {1.0f, -1.0f}) {
        for (const bool in_mean : {true, false}) {
            const auto quantised = [&](float value) {
                const std::vector<float> large{sign * value, 1.0f}, small{2.0f, 1.0f};
                ScaledFactors factors =
                    few_values(in_mean ? large : small, in_mean ? small : large, 4);
                factors.weights << 1, -1, 1, -1;
                return quantise(factors, quantiser);
            };
            const auto values = [&](const LowRank& matrix) {
                return in_mean ? matrix.mean : matrix.components.at(0);
            };
            EXPECT_TRUE(values(quantised(127.0f)).holds_i8());
            for (const float value : {128.0f, 32767.0f}) {
                const StoredValues stored = values(quantised(value));
                EXPECT_FALSE(stored.holds_i8() || stored.holds_floats());
                EXPECT_EQ(stored[0], sign * value);
                EXPECT_EQ(stored[1], 1.0f);
            }
            for (const float value : {32768.0f, 65536.0f, 1e9f}) {
                try {
                    quantised(value);
                    ADD_FAILURE() << value << " fits";
                } catch (const Error& error) {
                    EXPECT_EQ(error.code(), ExitCode::unsupported);
                    EXPECT_NE(std::string(error.what()).find("do not fit in 16 bits"),
                              std::string::npos);
                }
            }
        }
    }
}

// A component that moves in one pose, of values of 20000 steps: a step of its weights that costs as
// much as one of its values is √(P / Σ q²), of which its weight is many more than 16 bits count. So
// it is coarser.
TEST(Quantise, WeightsFitInSixteenBits) {
    constexpr Index kPoses = 4, kPoints = 100;
    ScaledFactors factors = few_values(std::vector<float>(kPoints, 0.0f),
                                       std::vector<float>(kPoints, 20000.0f), kPoses);
    factors.weights(0, 1) = 2.0;  // of unit RMS
    const LowRank matrix = quantise(factors, {1.0, kAll, {1.0}});
    ASSERT_EQ(matrix.num_components, 1u);
    const double step = matrix.weight_steps.at(0);
    const double alike = std::sqrt(kPoses / (kPoints * 20000.0 * 20000.0));
    ASSERT_GT(2.0 / alike, 3.0 * 32767.0) << "else this would not say much";
    // To a float's rounding.
    EXPECT_NEAR(step * 32767.0 / 2.0, 1.0, 0x1p-23);
    for (Index p = 0; p < kPoses; ++p) {
        const double weight = matrix.weights.at(static_cast<size_t>(p));
        EXPECT_LE(std::abs(weight / step), 32767.0 * (1.0 + 0x1p-23)) << p;
        EXPECT_NEAR(weight, factors.weights(0, p), 0.5 * step) << p;
    }
}

TEST(Quantise, OnePoseIsAMean) {
    ScaledFactors factors = random_factors({50, 2, 1, {}});
    const Quantiser quantiser{0.01, kAll, alike(factors)};
    const LowRank matrix = quantise(factors, quantiser);
    EXPECT_EQ(matrix.num_components, 0u);
    EXPECT_EQ(matrix.num_poses, 1u);
    // Floats of the decoded mean, 2^-24 of 1, are much smaller than errors of 0.003.
    EXPECT_NEAR(decoded(factors, quantiser) / quantised_error(factors, quantiser), 1.0, 1e-4);
}

}  // namespace
}  // namespace paim
