// Scenery as integers, as coarse as its errors may be.
#include "compressor/encode/search/quantise_scenery.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/quantise/quantise.h"

namespace paim {

namespace {

// A mean without components, of one pose.
Scores still_scores(std::vector<float> values, uint32_t num_points, uint32_t num_planes) {
    Scores scores;
    scores.num_points = num_points;
    scores.num_planes = num_planes;
    scores.mean = std::move(values);
    scores.weights.resize(0, 1);
    return scores;
}

// Steps of which the weighted squared error is at most this; floats if there are none.
StillPlanes quantise_planes(const StillPlanes& exact, const std::vector<double>& plane_weight,
                            uint32_t num_points, double most_error) {
    const Scores scores =
        still_scores(exact.floats(), num_points, static_cast<uint32_t>(plane_weight.size()));
    Quantiser quantiser{1.0, 0, plane_weight};
    quantiser.step = largest_step(scores, quantiser, most_error);
    if (quantiser.step == 0.0) return exact;
    LowRankMatrix still = quantise(scores, quantiser);
    return {std::move(still.mean), std::move(still.steps)};
}

}  // namespace

QuantisedScenery exact_scenery(const Material& material) {
    return {material.frame.scenery, material.floor.scenery};
}

QuantisedScenery quantise_scenery(const Material& material, double transfer_error,
                                  double distance) {
    const QuantisedScenery exact = exact_scenery(material);
    if (exact.scenery.empty()) return exact;
    const uint32_t num_vertices = exact.scenery.topology.num_vertices;
    const TransferError& floor = exact.error->transfer;
    double energy = 0.0;
    for (uint32_t l = 0; l < floor.bands.size(); ++l) {
        energy += material.spectrum.weight(l) * floor.bands[l].baked;
    }
    const double room = transfer_error * transfer_error - floor.total() * floor.total();
    double transfer_budget = std::max(0.0, room) * energy;
    double distance_budget = distance * distance * num_vertices;
    // Rounding and noise are independent, but only on average.
    constexpr int kMostRounds = 8;
    constexpr double kSmaller = 0.95;
    Model model = material.frame;
    for (int round = 0; round < kMostRounds; ++round) {
        model.scenery.positions = quantise_planes(exact.scenery.positions, {1.0, 1.0, 1.0},
                                                  num_vertices, distance_budget);
        model.scenery.transfer = quantise_planes(exact.scenery.transfer, material.plane_weight,
                                                 num_vertices, transfer_budget);
        const SceneryError error = measure_scenery(model, material.bake, material.spectrum);
        const bool transfer_good = error.transfer.total() <= transfer_error;
        const bool distance_good = error.geometry.rms() <= distance;
        if (transfer_good && distance_good) return {std::move(model.scenery), error};
        if (!transfer_good) transfer_budget *= kSmaller;
        if (!distance_good) distance_budget *= kSmaller;
    }
    return exact;
}

}  // namespace paim
