// The step that an error allows, of errors that are known in closed form.
#include "compressor/encode/quantise/largest_step.h"

#include <gtest/gtest.h>

#include <cmath>

namespace paim {
namespace {

constexpr double kSmallest = 1e-3;  // so that the coarsest is 32.767

double expect_found(const std::function<double(double)>& rough,
                    const std::function<double(double)>& error, double most) {
    const double step = largest_step(kSmallest, most, rough, error);
    EXPECT_LE(error(step), most);
    return step;
}

TEST(LargestStep, IsWhereTheErrorIsReached) {
    for (const double power : {1.0, 1.5, 2.0}) {
        for (const double least : {0.0, 0.5}) {
            const auto error = [&](double step) { return least + std::pow(step, power); };
            for (const double most : {least + 1e-4, least + 0.01, least + 3.0}) {
                const double step = expect_found(error, error, most);
                // Within 1 % of what it may add.
                EXPECT_GT(error(step) - least, 0.989 * (most - error(kSmallest)));
            }
        }
    }
}

TEST(LargestStep, CorrectsARoughError) {
    int num_asked = 0;
    const auto rough = [](double step) { return 0.1 + step * step; };
    const auto error = [&](double step) {
        ++num_asked;
        return 0.1 + 0.7 * step * step;
    };
    const double step = expect_found(rough, error, 0.2);
    EXPECT_NEAR(step, std::sqrt(0.1 / 0.7), 0.006 * step);
    EXPECT_LE(num_asked, 4);  // one of them here
}

// Rounding makes errors that jump.
TEST(LargestStep, StaysGoodWhereErrorsScatter) {
    const auto error = [](double step) {
        return step * step * (1.0 + 0.02 * std::sin(1e4 * step));
    };
    for (const double most : {1e-3, 0.1, 2.0}) {
        const double step = expect_found(error, error, most);
        EXPECT_NEAR(step, std::sqrt(most), 0.03 * step);
    }
}

TEST(LargestStep, KnowsItsLimits) {
    const auto square = [](double step) { return step * step; };
    EXPECT_EQ(largest_step(0.0, 1.0, square, square), 1.0);
    EXPECT_EQ(largest_step(kSmallest, 1e-7, square, square), 0.0);
    EXPECT_DOUBLE_EQ(largest_step(kSmallest, 1e9, square, square), 32767.0 * kSmallest);
    // Only the error itself is good.
    const auto half = [](double step) { return 0.5 * step * step; };
    EXPECT_EQ(largest_step(kSmallest, 0.7e-6, square, half), kSmallest);
}

}  // namespace
}  // namespace paim
