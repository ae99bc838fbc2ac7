// Steps that meet a target, measured.
#include "compressor/encode/search/rate_control.h"

#include "compressor/encode/quantise/float_part.h"
#include "compressor/encode/quantise/trim_bands.h"
#include "compressor/encode/search/step_scaling.h"
#include "paim/base/error.h"

namespace paim {

namespace {

Model build(const EncodeProblem& problem, const Scenery& scenery, const Coding& coding) {
    Model model = problem.frame;
    model.scenery = scenery;
    model.geometry = is_integer(coding.geometry_precision)
                         ? quantise(problem.geometry, coding.geometry)
                         : float_part(problem.geometry, coding.geometry.num_components,
                                      coding.geometry_precision);
    coding.transfer.apply(problem, model);
    trim_bands(model);
    return model;
}

// Floats have no step: one more component.
void adjust(Quantiser& quantiser, Precision precision, bool coarser, double error, double target,
            double floor) {
    constexpr double kSlack = 0.997;
    if (is_integer(precision)) {
        quantiser.step = scaled_step(quantiser.step, error, target, floor, kSlack);
    } else if (!coarser && error > target) {
        ++quantiser.num_components;
    }
}

}  // namespace

std::optional<RefinedModel> refine(const EncodeProblem& problem, const QuantisedScenery& still,
                                   Coding coding, const Targets& targets) {
    constexpr int kMaxRounds = 8;
    constexpr double kRoom = 0.985;  // below this share of a target a coarser step is tried
    const double floor = problem.floor.transfer.total();
    std::optional<RefinedModel> best;
    for (int round = 0; round < kMaxRounds; ++round) {
        Model model;
        try {
            model = build(problem, still.scenery, coding);
        } catch (const Error& error_of_step) {
            // Finer than values of 16 bits can be: what there is, is the best there is.
            if (error_of_step.code() != ExitCode::unsupported) throw;
            break;
        }
        ModelError measured = measure_animation(model, problem.bake, problem.spectrum);
        measured.scenery = still.error;
        const double transfer = measured.transfer.total();
        const double geometry = measured.geometry.rms();
        const bool good = transfer <= targets.transfer && geometry <= targets.geometry;
        if (best && !good) break;  // a step too far
        if (good) best = RefinedModel{std::move(model), measured, coding};
        const bool room =
            transfer < kRoom * targets.transfer || geometry < kRoom * targets.geometry;
        if (good && (!room || round >= 3)) break;
        const bool coarser = good;
        adjust(coding.transfer.quantiser, coding.transfer.precision, coarser, transfer,
               targets.transfer, floor);
        adjust(coding.geometry, coding.geometry_precision, coarser, geometry, targets.geometry,
               0.0);
    }
    return best;
}

void scale_steps(const EncodeProblem& problem, const Targets& from, const Targets& to,
                 Coding& coding) {
    if (is_integer(coding.transfer.precision)) {
        double& step = coding.transfer.quantiser.step;
        step = scaled_step(step, from.transfer, to.transfer, problem.floor.transfer.total(), 1.0);
    }
    if (is_integer(coding.geometry_precision)) {
        double& step = coding.geometry.step;
        step = scaled_step(step, from.geometry, to.geometry, 0.0, 1.0);
    }
}

}  // namespace paim
