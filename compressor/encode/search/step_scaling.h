// The step of integers that should give another error.
#pragma once

#include <algorithm>
#include <cmath>

namespace paim {

// What one scaling multiplies a step by, at least and at most.
constexpr double kFinestScaling = 0.5, kCoarsestScaling = 1.25;

// Errors above a floor grow about as the step does: error² = floor² + (k · step)² for some k.
// from, to  the error of this step, and the one that is wanted
// floor     the error that a step of nothing would leave
// slack     what the scaled step is multiplied by: a little below 1 stays a little below `to`
// Steps stay as they are where an error is not above the floor.
inline double scaled_step(double step, double from, double to, double floor, double slack) {
    const double now = from * from - floor * floor;
    const double wanted = to * to - floor * floor;
    if (!(now > 0.0 && wanted > 0.0)) return step;
    return step * std::clamp(slack * std::sqrt(wanted / now), kFinestScaling, kCoarsestScaling);
}

}  // namespace paim
