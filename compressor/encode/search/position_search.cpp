// Positions that meet a surface target: how many components, and with which step.
#include "compressor/encode/search/position_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "compressor/encode/quantise/choose_smoothing.h"
#include "compressor/encode/quantise/exceptions.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/search/part_search.h"
#include "compressor/encode/search/step_scaling.h"
#include "paim/base/error.h"

namespace paim {

namespace {

const std::vector<double>& alike() {
    static const std::vector<double> weights(3, 1.0);
    return weights;
}

// An RMS distance as a sum of squares over the vertices of faces and all poses.
double squared_distances(const EncodeProblem& problem, double rms) {
    return rms * rms * static_cast<double>(problem.num_face_vertices) *
           problem.geometry.num_poses();
}

SurfaceError measure(const EncodeProblem& problem, const LowRank& positions) {
    const SurfaceError error = problem.meter->surface(positions);
    problem.progress->advance(0.05);
    return error;
}

// Floats with the fewest components whose rest is at most `most_error`, a sum of squares.
PositionCoding floats_within(const EncodeProblem& problem, double most_error, Precision precision) {
    const std::vector<double> tails = tail_errors(problem.geometry, alike());
    uint32_t k = problem.least_geometry_components;
    while (k + 1 < tails.size() && tails[k] > most_error) ++k;
    const uint64_t value = precision == Precision::f16 ? 2 : 4;
    return {{1.0, k, alike()}, precision, problem.geometry.mean.size() * (4 + k * value)};
}

// Floats with about the fewest components that meet the target, measured.
std::optional<RefinedPositions> float_positions(const EncodeProblem& problem, Precision precision,
                                                const SurfaceTarget& target) {
    if (!(excess(problem.best_achievable, target) <= 1.0)) return std::nullopt;
    // What rounding to floats and components that were dropped before take is spent already.
    double room = std::max(0.0, squared_distances(problem, target.distance) -
                                    problem.best_achievable.geometry.distance.squared_sum);
    const uint32_t most = problem.geometry.num_components();
    uint32_t fewest = 0;
    while (true) {
        PositionCoding coding = floats_within(problem, room, precision);
        uint32_t& count = coding.quantiser.num_components;
        count = std::max(count, fewest);
        LowRank matrix = code_positions(problem, coding);
        SurfaceError error = measure(problem, matrix);
        const double over = excess(error, target);
        if (over <= 1.0) return RefinedPositions{std::move(matrix), error, std::move(coding)};
        if (count == most) return std::nullopt;  // half floats are rounded more than others
        fewest = count + 1;
        room *= over < 1e3 ? std::pow(0.9 / over, 2.0) : 1e-6;
    }
}

// A step that was too coarse, and the excess that it had.
struct StepMiss {
    double step, excess;
};

// The excess without any rounding, by two of them: squares of excesses are linear in those of steps. As
// large as the later one where a finer step did not help.
double excess_without_step(const StepMiss& before, const StepMiss& after) {
    const double steps = before.step * before.step - after.step * after.step;
    const double gained = before.excess * before.excess - after.excess * after.excess;
    if (!(steps > 0.0 && gained > 0.0)) return after.excess;
    const double left = after.excess * after.excess - gained / steps * after.step * after.step;
    return left > 0.0 ? std::sqrt(left) : 0.0;
}

// Nothing if steps are finer than values of 16 bits can be.
std::optional<LowRank> code_if_it_fits(const EncodeProblem& problem, const PositionCoding& coding) {
    try {
        return code_positions(problem, coding);
    } catch (const Error& error_of_step) {
        if (error_of_step.code() != ExitCode::unsupported) throw;
        return std::nullopt;
    }
}

}  // namespace

LowRank code_positions(const EncodeProblem& problem, const PositionCoding& coding) {
    LowRank positions =
        is_integer(coding.precision)
            ? smoothed(problem.geometry, coding.quantiser, *problem.smoother)
            : float_matrix(problem.geometry, coding.quantiser.num_components, coding.precision);
    append_exceptions(problem.file_outliers, positions);
    return positions;
}

std::optional<PositionCoding> choose_positions(const EncodeProblem& problem, Precision precision,
                                               const SurfaceTarget& target) {
    if (!(excess(problem.best_achievable, target) <= 1.0)) return std::nullopt;
    const auto as_floats = [&](Precision floats) -> std::optional<PositionCoding> {
        auto positions = float_positions(problem, floats, target);
        if (!positions) return std::nullopt;
        return std::move(positions->coding);
    };
    if (!is_integer(precision)) return as_floats(precision);
    // Estimates know distances alone. Neither what smoothing gains nor what the surface needs is
    // known before it is measured, so the distance that estimates are given is changed until it is
    // right.
    constexpr int kMaxRounds = 6;
    constexpr double kRoom = 0.93, kAim = 0.965;
    constexpr double kFinest = 0.2, kCoarsest = 2.0;  // changes of the distance
    std::optional<PositionCoding> coding;
    double distance = target.distance;
    for (int round = 0; round < kMaxRounds; ++round) {
        // Vertices that no face has come last.
        auto choice = cheapest_part(
            part_choices(problem.geometry, alike(), squared_distances(problem, distance),
                         problem.geometry.num_components(), problem.predictor,
                         problem.num_face_vertices, problem.least_geometry_components));
        if (!choice) break;
        coding = PositionCoding{std::move(choice->quantiser), Precision::i16, choice->bytes};
        const auto matrix = code_if_it_fits(problem, *coding);
        if (!matrix) break;
        const double over = excess(measure(problem, *matrix), target);
        if (std::isnan(over)) break;
        if (over <= 1.0 && over > kRoom) return coding;
        distance *= over > 0.0 ? std::clamp(kAim / over, kFinest, kCoarsest) : kCoarsest;
    }
    return coding ? coding : as_floats(Precision::f32);
}

std::optional<RefinedPositions> refine_positions(const EncodeProblem& problem,
                                                 PositionCoding coding,
                                                 const SurfaceTarget& target) {
    if (!is_integer(coding.precision)) return float_positions(problem, coding.precision, target);
    constexpr int kMaxRounds = 10;
    constexpr double kRoom = 0.985;  // below this share of the target a coarser step is tried
    constexpr double kSlack = 0.995;
    constexpr double kCoarsest = 1.6;
    constexpr double kClose = 1.01;      // steps that are not told apart
    constexpr double kAlmostAll = 0.97;  // of the error: dropped components leave no room for steps
    std::optional<RefinedPositions> best;
    std::optional<StepMiss> last_miss;
    double too_coarse = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kMaxRounds; ++round) {
        std::optional<LowRank> matrix = code_if_it_fits(problem, coding);
        if (!matrix) break;
        const SurfaceError error = measure(problem, *matrix);
        const double over = excess(error, target);
        double& step = coding.quantiser.step;
        double without_step = 0.0;  // the excess that a step of 0 would have
        if (over <= 1.0) {
            best = RefinedPositions{std::move(*matrix), error, coding};
            if (over >= kRoom) break;
        } else {
            too_coarse = step;
            if (last_miss) without_step = excess_without_step(*last_miss, {step, over});
            last_miss = {step, over};
        }
        uint32_t& count = coding.quantiser.num_components;
        if (!best && without_step > kAlmostAll && count < problem.geometry.num_components()) {
            ++count;
            last_miss.reset();
            too_coarse = std::numeric_limits<double>::infinity();
            continue;
        }
        const double finest = best ? best->coding.quantiser.step : 0.0;
        if (finest > 0.0 && too_coarse < kClose * finest) break;
        step = scaled_step(step, over, 1.0, without_step, kSlack, kCoarsest);
        if (step <= finest || step >= too_coarse) step = std::sqrt(finest * too_coarse);
        if (!std::isfinite(step) || step == 0.0) break;
    }
    return best ? std::move(best) : float_positions(problem, Precision::f32, target);
}

const PositionCoding* PositionFinder::choose(const SurfaceTarget& target) {
    if (chosen_for_ != target) {
        chosen_ = choose_positions(problem_, precision_, target);
        chosen_for_ = target;
    }
    return chosen_ ? &*chosen_ : nullptr;
}

const RefinedPositions* PositionFinder::refine(const PositionCoding& coding,
                                               const SurfaceTarget& target) {
    const std::pair asked(coding, target);
    if (refined_for_ != asked) {
        refined_.reset();  // first, so that there is memory
        refined_for_.reset();
        refined_ = refine_positions(problem_, coding, target);
        refined_for_ = asked;
    }
    return refined_ ? &*refined_ : nullptr;
}

}  // namespace paim
