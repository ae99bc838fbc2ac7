// The cheapest integers of a part, against every number of components and every step of a fine
// grid.
#include "compressor/encode/search/part_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "compressor/encode/search/matrix_cost.h"
#include "tests/unit/encode/quantise/random_factors.h"

namespace paim {
namespace {

const std::vector<double> kPlaneWeight{1.0, 0.5, 2.0, 0.1};

ScaledFactors factors_of(const std::vector<double>& sizes, uint32_t num_points = 2000) {
    FactorsShape shape;
    shape.num_points = num_points;
    shape.sizes = sizes;
    return random_factors(shape);
}

std::vector<PartChoice> choices(const ScaledFactors& factors, double most_error,
                                uint32_t most_components = 99) {
    return part_choices(factors, kPlaneWeight, most_error,
                        std::min(most_components, factors.num_components()), PlanePredictor(),
                        factors.num_points);
}

uint64_t bytes_of(const ScaledFactors& factors, const Quantiser& quantiser) {
    return stored_bytes(quantise(factors, quantiser), PlanePredictor(), Effort::fast);
}

TEST(PartSearch, TailErrorsAreThoseOfTheComponentsThatAreLeftOut) {
    const ScaledFactors factors = factors_of({1.0, 0.5, 0.25, 0.1}, 300);
    const std::vector<double> tails = tail_errors(factors, kPlaneWeight);
    ASSERT_EQ(tails.size(), 5u);
    for (uint32_t k = 0; k <= 4; ++k) {
        ScaledFactors kept = factors;
        kept.components.resize(k);
        kept.weights.conservativeResize(k, Eigen::NoChange);
        double left = 0.0;
        for (uint32_t j = 0; j < factors.num_planes; ++j) {
            left +=
                kPlaneWeight[j] * (exact_plane(factors, j) - exact_plane(kept, j)).squaredNorm();
        }
        // Weights are orthogonal and of unit RMS to some 1e-15; sums of 14,400 squares in double.
        EXPECT_NEAR(tails[k], left, 1e-12 * tails[0]) << k;
    }
}

TEST(PartSearch, StepsAreTheLargestThatMeetTheError) {
    const ScaledFactors factors = factors_of({1.0, 0.5, 0.25, 0.12, 0.06, 0.03});
    const std::vector<double> tails = tail_errors(factors, kPlaneWeight);
    for (const double most : {0.9 * tails[0], 0.5 * tails[2], 0.02 * tails[4]}) {
        const std::vector<PartChoice> found = choices(factors, most);
        ASSERT_FALSE(found.empty());
        uint32_t before = 0;
        for (const PartChoice& choice : found) {
            EXPECT_LE(quantised_error(factors, choice.quantiser), most);
            Quantiser coarser = choice.quantiser;
            // They end within 0.5 % of the largest. A step 3 % larger errs 5 % more than that, in
            // squares, if dropped components have no part in it; squares of roundings of
            // 2000 · 4 values and more scatter by √(0.8 / 8000) = 1 %.
            coarser.step *= 1.03;
            const double dropped = tails[choice.quantiser.num_components];
            if (dropped < 0.3 * most) {
                EXPECT_GT(quantised_error(factors, coarser), most);
            }
            EXPECT_EQ(choice.bytes, bytes_of(factors, choice.quantiser));
            EXPECT_LE(choice.num_components, choice.quantiser.num_components);
            EXPECT_TRUE(&choice == &found.front() || choice.quantiser.num_components > before);
            before = choice.quantiser.num_components;
        }
    }
}

// The fewest bytes of all steps of a grid, 1 % apart, and all numbers of components.
uint64_t fewest_bytes(const ScaledFactors& factors, double most_error) {
    uint64_t fewest = std::numeric_limits<uint64_t>::max();
    for (uint32_t k = 0; k <= factors.num_components(); ++k) {
        Quantiser quantiser{1.0, k, kPlaneWeight};
        const double smallest = smallest_step(factors, quantiser, Precision::i16);
        // From the coarsest on, the first that meets the error has the fewest bytes.
        for (double step = 32767.0 * smallest; step > smallest; step /= 1.01) {
            quantiser.step = step;
            if (quantised_error(factors, quantiser) > most_error) continue;
            fewest = std::min(fewest, bytes_of(factors, quantiser));
            break;
        }
    }
    return fewest;
}

TEST(PartSearch, IsAsGoodAsEveryStepOfAGridAndEveryNumberOfComponents) {
    const ScaledFactors factors = factors_of({1.0, 0.5, 0.25, 0.12, 0.06, 0.03}, 1000);
    const std::vector<double> tails = tail_errors(factors, kPlaneWeight);
    for (const double most : {0.8 * tails[0], 1.5 * tails[1], 0.9 * tails[2], 2.0 * tails[3],
                              0.7 * tails[4], 0.1 * tails[5]}) {
        const auto best = cheapest_part(choices(factors, most));
        ASSERT_TRUE(best);
        const auto fewest = static_cast<double>(fewest_bytes(factors, most));
        // For fewer components, 1 % is given away. Steps end within 0.5 % of the largest; a step
        // that is so much finer takes log2(1.005) = 0.007 bits more a value, of which each takes
        // more than one here: 0.7 %. The grid's own steps end within 1 % of the largest: 1.4 %.
        RecordProperty("bytes_of_fewest_" + std::to_string(most / tails[0]),
                       std::to_string(static_cast<double>(best->bytes) / fewest));
        EXPECT_LE(static_cast<double>(best->bytes), 1.017 * fewest) << most;
        EXPECT_GE(static_cast<double>(best->bytes), 0.985 * fewest) << most;
    }
}

TEST(PartSearch, KeepsNoMoreComponentsThanAreAllowed) {
    const ScaledFactors factors = factors_of({1.0, 0.5, 0.25}, 300);
    const std::vector<double> tails = tail_errors(factors, kPlaneWeight);
    for (const PartChoice& choice : choices(factors, 1.1 * tails[2], 2)) {
        EXPECT_LE(choice.quantiser.num_components, 2u);
    }
    EXPECT_FALSE(choices(factors, 1.1 * tails[2], 2).empty());
    EXPECT_TRUE(choices(factors, 0.9 * tails[2], 2).empty());
}

TEST(PartSearch, FindsNothingForErrorsBelowSixteenBits) {
    const ScaledFactors factors = factors_of({1.0, 0.5}, 300);
    EXPECT_TRUE(choices(factors, 0.0).empty());
    EXPECT_FALSE(cheapest_part({}));
    // Roundings to the finest step are a twelfth of its square each, of the mean and two components
    // at 300 · 4 places. They scatter by √(0.8 / 3600) = 1.5 %; the dead zone adds less than that.
    // The fit to the integers counts up to 1e-10 of the components' squares as an error, too: up to
    // 32767² / 3 · 1e-10 = 0.036 of a square where a rounding is a twelfth, 0.083, in two parts of
    // three.
    const double step = smallest_step(factors, {1.0, 2, kPlaneWeight}, Precision::i16);
    const double finest = step * step / 12.0 * 300 * 4 * 3 * factors.num_poses();
    EXPECT_TRUE(choices(factors, 0.95 * finest).empty());
    EXPECT_FALSE(choices(factors, 1.3 * finest).empty());
}

TEST(PartSearch, TakesFewerComponentsForOnePercentOfTheBytes) {
    const auto cheapest = [](const std::vector<uint64_t>& bytes) {
        std::vector<PartChoice> choices(bytes.size());
        for (size_t j = 0; j < bytes.size(); ++j) {
            choices[j].num_components = static_cast<uint32_t>(j);
            choices[j].bytes = bytes[j];
        }
        return cheapest_part(std::move(choices))->num_components;
    };
    EXPECT_EQ(cheapest({500}), 0u);
    EXPECT_EQ(cheapest({1011, 1010, 1000, 1300}), 1u);
    EXPECT_EQ(cheapest({1011, 1011, 1000, 1300}), 2u);
    EXPECT_EQ(cheapest({2000, 1500, 1200, 1001}), 3u);
}

}  // namespace
}  // namespace paim
