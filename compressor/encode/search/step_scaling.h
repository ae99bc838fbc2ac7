// The step of integers that should give another error.
#pragma once

#include <algorithm>
#include <cmath>

namespace paim {

// What one scaling multiplies a step by, at least and at most.
constexpr double kFinestScaling = 0.5, kCoarsestScaling = 1.25;

// An error is about √(best_error² + (k · step)²) for some k.
// from, to    the error of this step, and the one that is wanted
// best_error  the error that would be left if the step were 0
// slack       multiplies the scaled step: a little below 1 stays a little below `to`
// coarsest    the most that the step is multiplied by
// Steps stay as they are where an error is not above the best one.
inline double scaled_step(double step, double from, double to, double best_error, double slack,
                          double coarsest = kCoarsestScaling) {
    const double now = from * from - best_error * best_error;
    const double wanted = to * to - best_error * best_error;
    if (!(now > 0.0 && wanted > 0.0)) return step;
    return step * std::clamp(slack * std::sqrt(wanted / now), kFinestScaling, coarsest);
}

}  // namespace paim
