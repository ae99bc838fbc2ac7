// Scenery as integers, as coarse as its errors may be.
#include "compressor/encode/search/quantise_scenery.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/quantise/quantise.h"

namespace paim {

namespace {

// A mean without components, of one pose.
ScaledFactors still_factors(std::vector<float> values, uint32_t num_points, uint32_t num_planes) {
    ScaledFactors factors;
    factors.num_points = num_points;
    factors.num_planes = num_planes;
    factors.mean = std::move(values);
    factors.weights.resize(0, 1);
    return factors;
}

// Steps of which the weighted squared error is at most this; floats if there are none.
StillPlanes quantise_planes(const StillPlanes& exact, const std::vector<double>& plane_weight,
                            uint32_t num_points, double most_error) {
    const ScaledFactors factors =
        still_factors(exact.floats(), num_points, static_cast<uint32_t>(plane_weight.size()));
    Quantiser quantiser{1.0, 0, plane_weight};
    quantiser.step = largest_step(factors, quantiser, most_error);
    if (quantiser.step == 0.0) return exact;
    LowRankMatrix still = quantise(factors, quantiser);
    return {std::move(still.mean), std::move(still.steps)};
}

}  // namespace

QuantisedScenery exact_scenery(const EncodeProblem& problem) {
    return {problem.frame.scenery, problem.floor.scenery};
}

QuantisedScenery quantise_scenery(const EncodeProblem& problem, double transfer_error,
                                  double distance) {
    const QuantisedScenery exact = exact_scenery(problem);
    if (exact.scenery.empty()) return exact;
    const uint32_t num_vertices = exact.scenery.topology.num_vertices;
    const TransferError& floor = exact.error->transfer;
    double energy = 0.0;
    for (uint32_t l = 0; l < floor.bands.size(); ++l) {
        energy += problem.spectrum.weight(l) * floor.bands[l].baked;
    }
    const double room = transfer_error * transfer_error - floor.total() * floor.total();
    double transfer_budget = std::max(0.0, room) * energy;
    double distance_budget = distance * distance * num_vertices;
    // The budget takes rounding and noise for uncorrelated. They are, but only on average.
    constexpr int kMaxRounds = 8;
    constexpr double kSmaller = 0.95;
    Model model = problem.frame;
    for (int round = 0; round < kMaxRounds; ++round) {
        model.scenery.positions = quantise_planes(exact.scenery.positions, {1.0, 1.0, 1.0},
                                                  num_vertices, distance_budget);
        model.scenery.transfer = quantise_planes(exact.scenery.transfer, problem.plane_weight,
                                                 num_vertices, transfer_budget);
        const SceneryError error = measure_scenery(model, problem.bake, problem.spectrum);
        const bool transfer_good = error.transfer.total() <= transfer_error;
        const bool distance_good = error.geometry.rms() <= distance;
        if (transfer_good && distance_good) return {std::move(model.scenery), error};
        if (!transfer_good) transfer_budget *= kSmaller;
        if (!distance_good) distance_budget *= kSmaller;
    }
    return exact;
}

}  // namespace paim
