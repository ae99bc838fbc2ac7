// Steps that meet an error, where errors are √(floor² + (k · step)²).
#include "compressor/encode/search/step_scaling.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

struct Law {
    double floor = 0.0, k = 1.0;
    double error(double step) const { return std::hypot(floor, k * step); }
    double step(double error) const { return std::sqrt(error * error - floor * floor) / k; }
};

TEST(StepScaling, MeetsAnErrorOfTheLawAtOnce) {
    for (const double floor : {0.0, 0.003, 0.009}) {
        const Law law{floor, 0.7};
        for (const double from : {0.0095, 0.01, 0.012}) {
            for (const double to : {0.0095, 0.01, 0.0105}) {
                const double before = law.step(from), wanted = law.step(to);
                const double scaling = wanted / before;
                if (scaling < kFinestScaling || scaling > kCoarsestScaling) continue;
                // A dozen roundings; differences of squares lose a digit near the floor.
                EXPECT_NEAR(scaled_step(before, from, to, floor, 1.0) / wanted, 1.0, 1e-13);
                // Steps that are so much smaller err less by as much of what is above the floor.
                const double slack = std::max(0.95, kFinestScaling / scaling);
                const double after = scaled_step(before, from, to, floor, slack);
                EXPECT_NEAR(law.step(law.error(after)) / (slack * wanted), 1.0, 1e-13);
            }
        }
    }
}

TEST(StepScaling, GoesNoFurtherThanItsEnds) {
    EXPECT_EQ(scaled_step(3.0, 0.1, 0.001, 0.0, 1.0), 1.5);
    EXPECT_EQ(scaled_step(3.0, 0.001, 0.1, 0.0, 1.0), 3.75);
    EXPECT_EQ(scaled_step(3.0, 0.1, 0.05, 0.0, 0.9), 1.5);
}

TEST(StepScaling, LeavesStepsThatHaveNoPartInTheError) {
    EXPECT_EQ(scaled_step(3.0, 0.01, 0.02, 0.01, 1.0), 3.0);   // at the floor: none
    EXPECT_EQ(scaled_step(3.0, 0.009, 0.02, 0.01, 1.0), 3.0);  // below it: noise that is fitted
    EXPECT_EQ(scaled_step(3.0, 0.02, 0.01, 0.01, 1.0), 3.0);   // no step gives the floor
    EXPECT_EQ(scaled_step(3.0, 0.02, 0.005, 0.01, 1.0), 3.0);  // nor less
    EXPECT_EQ(scaled_step(3.0, 0.0, 0.01, 0.0, 1.0), 3.0);
    EXPECT_EQ(scaled_step(3.0, std::nan(""), 0.01, 0.0, 1.0), 3.0);
}

// As rate control does it: measured, scaled, measured again, until the error is within the target
// and not below 0.985 of it. Without ends, one scaling would do: each of the two more that a step
// 2.5 times too coarse, or 1.9 times too fine, needs goes to an end.
TEST(StepScaling, ConvergesFromStepsThatAreFarOff) {
    for (const double floor : {0.0, 0.005, 0.0099}) {
        const Law law{floor, 2.0};
        constexpr double kTarget = 0.01;
        for (const double off : {1.0 / 1.9, 0.8, 1.0, 1.3, 2.5}) {
            double step = off * law.step(kTarget);
            int rounds = 0;
            while (law.error(step) > kTarget || law.error(step) < 0.985 * kTarget) {
                ASSERT_LT(++rounds, 4) << floor << ' ' << off;
                step = scaled_step(step, law.error(step), kTarget, floor, 0.997);
            }
        }
    }
}

}  // namespace
}  // namespace paim
