// The step that an error allows: the secant rule in logarithms, kept inside what is known.
#include "compressor/encode/quantise/largest_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/codec/stored_values.h"

namespace paim {

namespace {

// From `smallest` to `coarsest`, for an error that adds at most `room` to `least`, that of the
// smallest step. Begins at `step`.
double step_within(double smallest, double coarsest, double step, double least, double room,
                   const std::function<double(double)>& error_of) {
    constexpr int kMaxRounds = 40;
    constexpr double kClose = 0.998, kAim = 0.999;  // shares of the room
    constexpr double kSame = 1.0001;                // steps that are not told apart
    constexpr double kFarthest = 16.0;              // change of the step in one round
    double good = smallest, bad = std::numeric_limits<double>::infinity();
    double power = 2.0;  // of what is added by the step, which rounding alone makes a square
    double last_step = 0.0, last_added = 0.0;
    for (int round = 0; round < kMaxRounds; ++round) {
        const double added = error_of(step) - least;
        (added <= room ? good : bad) = step;
        if (good == coarsest || bad <= kSame * good) break;
        if (added <= room && added >= kClose * room) break;
        if (added > 0.0 && last_added > 0.0) {
            power = std::log(added / last_added) / std::log(step / last_step);
            power = std::clamp(power, 0.5, 3.0);
        }
        last_step = step;
        last_added = added;
        const double change = added > 0.0 ? std::pow(kAim * room / added, 1.0 / power) : kFarthest;
        step = std::min(coarsest, step * std::clamp(change, 1.0 / kFarthest, kFarthest));
        if (!(step > good && step < bad)) step = std::sqrt(good * std::min(bad, coarsest));
    }
    return good;
}

}  // namespace

double largest_step(double smallest, double most, const std::function<double(double)>& rough_error,
                    const std::function<double(double)>& error) {
    if (smallest == 0.0) return 1.0;
    constexpr int kMaxRounds = 5;
    constexpr double kClose = 0.99, kAim = 0.997;  // shares of the room
    constexpr double kUsualLevels = 64.0;          // largest value of usual files, in steps
    const double coarsest = largest_integer(Precision::i16) * smallest;
    const double least = rough_error(smallest);
    // Rough errors are too large: what is not good by them may still be.
    if (!(least <= most)) return error(smallest) <= most ? smallest : 0.0;
    double rough_room = most - least;
    double step = coarsest / kUsualLevels, best = smallest;
    for (int round = 0; round < kMaxRounds; ++round) {
        step = step_within(smallest, coarsest, step, least, rough_room, rough_error);
        const double added = error(step) - least;
        const bool good = added <= most - least;
        if (good) best = std::max(best, step);
        if (good && (step == coarsest || added >= kClose * (most - least))) break;
        if (!(added > 0.0)) break;
        rough_room *= kAim * (most - least) / added;
    }
    return best;
}

}  // namespace paim
