// Scenery as integers, as coarse as its errors may be.
#include "compressor/encode/quantise_scenery.h"

#include <algorithm>
#include <cmath>

#include "compressor/encode/quantise.h"

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

Scenery quantise_scenery(const Material& material, double transfer_error, double distance) {
    Scenery scenery = material.frame.scenery;
    if (scenery.empty()) return scenery;
    const uint32_t num_vertices = scenery.topology.num_vertices;
    scenery.positions = quantise_planes(scenery.positions, {1.0, 1.0, 1.0}, num_vertices,
                                        distance * distance * num_vertices);

    const TransferError& floor = material.floor.scenery->transfer;
    double energy = 0.0;
    for (uint32_t l = 0; l < floor.bands.size(); ++l) {
        energy += material.spectrum.weight(l) * floor.bands[l].baked;
    }
    const double room = transfer_error * transfer_error - floor.total() * floor.total();
    double budget = std::max(0.0, room) * energy;
    Model model = material.frame;
    model.scenery = scenery;
    // Rounding and noise are independent, but only on average.
    constexpr int kMostRounds = 8;
    for (int round = 0; round < kMostRounds; ++round, budget *= 0.95) {
        model.scenery.transfer =
            quantise_planes(scenery.transfer, material.plane_weight, num_vertices, budget);
        if (model.scenery.transfer.values.holds_floats()) break;
        const SceneryError error = measure_scenery(model, material.bake, material.spectrum);
        if (error.transfer.total() <= transfer_error) break;
    }
    return model.scenery;
}

}  // namespace paim
