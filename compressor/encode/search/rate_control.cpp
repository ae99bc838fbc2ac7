// Steps that meet a target, measured.
#include "compressor/encode/search/rate_control.h"

#include "compressor/encode/quantise/choose_smoothing.h"
#include "compressor/encode/quantise/exceptions.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/quantise/trim_bands.h"
#include "compressor/encode/search/step_scaling.h"
#include "paim/base/error.h"

namespace paim {

namespace {

Asset build(const EncodeProblem& problem, const QuantisedStill& still, const Coding& coding) {
    Asset asset = problem.shell;
    if (still.mesh) *asset.still() = *still.mesh;
    CodedMesh& mesh = asset.moving();
    mesh.positions = is_integer(coding.geometry_precision)
                         ? smoothed(problem.geometry, coding.geometry, mesh.topology)
                         : float_matrix(problem.geometry, coding.geometry.num_components,
                                        coding.geometry_precision);
    append_exceptions(problem.file_outliers, mesh.positions);
    const TransferCoding& transfer = coding.transfer;
    mesh.transfer = transfer.settings->code(problem, transfer.quantiser, transfer.precision);
    trim_bands(asset);
    return asset;
}

// Nothing if steps are finer than values of 16 bits can be.
std::optional<Asset> build_if_it_fits(const EncodeProblem& problem, const QuantisedStill& still,
                                      const Coding& coding) {
    try {
        return build(problem, still, coding);
    } catch (const Error& error_of_step) {
        if (error_of_step.code() != ExitCode::unsupported) throw;
        return std::nullopt;
    }
}

// Estimates of positions know nothing of smoothing, which leaves room for much coarser steps.
constexpr double kCoarsestPositions = 1.6;

// Floats have no step: one more component.
void adjust(Quantiser& quantiser, Precision precision, bool coarser, double error, double target,
            double best_error, double coarsest) {
    constexpr double kSlack = 0.997;
    if (is_integer(precision)) {
        quantiser.step = scaled_step(quantiser.step, error, target, best_error, kSlack, coarsest);
    } else if (!coarser && error > target) {
        ++quantiser.num_components;
    }
}

}  // namespace

std::optional<RefinedAsset> refine(const EncodeProblem& problem, const QuantisedStill& still,
                                   Coding coding, const Targets& targets) {
    constexpr int kMaxRounds = 8;
    constexpr double kRoom = 0.985;  // below this share of a target a coarser step is tried
    const double best_error = problem.best_achievable.transfer.total();
    std::optional<RefinedAsset> best;
    for (int round = 0; round < kMaxRounds; ++round) {
        std::optional<Asset> asset = build_if_it_fits(problem, still, coding);
        if (!asset && !best && is_integer(coding.geometry_precision) &&
            use_float_positions(problem, targets.geometry, coding)) {
            asset = build_if_it_fits(problem, still, coding);
        }
        if (!asset) break;  // what there is, is the best there is
        const AssetError measured{measure_part(*asset, 0, problem.bake, problem.spectrum),
                                  still.error};
        const double transfer = measured.transfer.total();
        const double geometry = measured.geometry.rms();
        const bool good = transfer <= targets.transfer && geometry <= targets.geometry;
        if (best && !good) break;  // a step too far
        if (good) best = RefinedAsset{std::move(*asset), measured, coding};
        const bool room =
            transfer < kRoom * targets.transfer || geometry < kRoom * targets.geometry;
        if (good && (!room || round >= 3)) break;
        const bool coarser = good;
        adjust(coding.transfer.quantiser, coding.transfer.precision, coarser, transfer,
               targets.transfer, best_error, kCoarsestScaling);
        adjust(coding.geometry, coding.geometry_precision, coarser, geometry, targets.geometry, 0.0,
               kCoarsestPositions);
    }
    return best;
}

void scale_steps(const EncodeProblem& problem, const Targets& from, const Targets& to,
                 Coding& coding) {
    if (is_integer(coding.transfer.precision)) {
        double& step = coding.transfer.quantiser.step;
        step = scaled_step(step, from.transfer, to.transfer,
                           problem.best_achievable.transfer.total(), 1.0);
    }
    if (is_integer(coding.geometry_precision)) {
        double& step = coding.geometry.step;
        step = scaled_step(step, from.geometry, to.geometry, 0.0, 1.0);
    }
}

}  // namespace paim
