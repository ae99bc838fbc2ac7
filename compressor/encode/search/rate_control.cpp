// Steps that meet a target, measured.
#include "compressor/encode/search/rate_control.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/quantise/trim_bands.h"
#include "compressor/encode/search/step_scaling.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// With the positions that are there. Nothing if the transfer's step is finer than values of 16 bits
// can be.
std::optional<Asset> build_if_it_fits(const EncodeProblem& problem, const QuantisedStill& still,
                                      const LowRank& positions, const TransferCoding& transfer) {
    try {
        Asset asset = problem.shell;
        if (still.mesh) *asset.still() = *still.mesh;
        asset.moving().positions = positions;
        asset.moving().transfer =
            transfer.settings->code(problem, transfer.quantiser, transfer.precision);
        trim_bands(asset);
        return asset;
    } catch (const Error& error_of_step) {
        if (error_of_step.code() != ExitCode::unsupported) throw;
        return std::nullopt;
    }
}

// Floats have no step: one more component.
void adjust(TransferCoding& transfer, double error, double target, double best_error) {
    constexpr double kSlack = 0.997;
    if (is_integer(transfer.precision)) {
        double& step = transfer.quantiser.step;
        step = scaled_step(step, error, target, best_error, kSlack);
    } else if (error > target) {
        ++transfer.quantiser.num_components;
    }
}

}  // namespace

std::optional<RefinedAsset> refine(const EncodeProblem& problem, const QuantisedStill& still,
                                   const RefinedPositions& positions, Coding coding,
                                   const Targets& targets) {
    coding.positions = positions.coding;
    constexpr int kMaxRounds = 8;
    constexpr double kRoom = 0.992;  // below this share of the target a coarser step is tried
    const double best_error = problem.best_achievable.transfer.total();
    std::optional<RefinedAsset> best;
    for (int round = 0; round < kMaxRounds; ++round) {
        std::optional<Asset> asset =
            build_if_it_fits(problem, still, positions.matrix, coding.transfer);
        if (!asset) break;  // what there is, is the best there is
        const AssetError measured{
            {positions.error, problem.meter->transfer(asset->moving(), problem.spectrum)},
            still.error};
        problem.progress->advance(0.5);
        const double transfer = measured.transfer.total();
        const bool good = transfer <= targets.transfer;
        if (best && !good) break;  // a step too far
        if (good) best = RefinedAsset{std::move(*asset), measured, coding};
        if (good && (transfer >= kRoom * targets.transfer || round >= 3)) break;
        if (good && transfer <= best_error) break;  // no step is known to give more
        adjust(coding.transfer, transfer, targets.transfer, best_error);
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
    if (is_integer(coding.positions.precision)) {
        // The error that changes least, or becomes smallest, is the one to meet.
        const SurfaceTarget &before = from.surface, &after = to.surface;
        const double change = std::min({after.distance / before.distance, after.sted / before.sted,
                                        after.normal_angle_deg / before.normal_angle_deg});
        double& step = coding.positions.quantiser.step;
        step = scaled_step(step, 1.0, change, 0.0, 1.0);
    }
}

}  // namespace paim
