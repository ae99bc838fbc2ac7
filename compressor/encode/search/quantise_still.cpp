// The still part as integers.
#include "compressor/encode/search/quantise_still.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/quantise/quantise.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// Integers with the largest step whose weighted squared error is at most this; floats if there is
// none.
LowRank quantise_mean(const LowRank& exact, const std::vector<double>& plane_weight,
                      double most_error) {
    ScaledFactors factors;  // a mean without components, of one pose
    factors.num_points = exact.num_points;
    factors.num_planes = exact.num_planes;
    factors.mean = exact.mean.floats();
    factors.weights.resize(0, 1);
    Quantiser quantiser{1.0, 0, plane_weight};
    quantiser.step = largest_step(factors, quantiser, most_error);
    if (quantiser.step == 0.0) return exact;
    LowRank matrix = quantise(factors, quantiser);
    return LowRank::still(exact.num_planes, std::move(matrix.mean), std::move(matrix.steps));
}

}  // namespace

QuantisedStill exact_still(const EncodeProblem& problem) {
    const CodedMesh* const mesh = problem.shell.still();
    if (mesh == nullptr) return {};
    return {*mesh, problem.best_achievable.still};
}

QuantisedStill quantise_still(const EncodeProblem& problem, double transfer_error,
                              double distance) {
    QuantisedStill exact = exact_still(problem);
    if (!exact.mesh) return exact;
    const TransferError& best = exact.error->transfer;
    double energy = 0.0;
    for (uint32_t l = 0; l < best.bands.size(); ++l) {
        energy += problem.spectrum.weight(l) * best.bands[l].baked;
    }
    const double room = transfer_error * transfer_error - best.total() * best.total();
    double transfer_budget = std::max(0.0, room) * energy;
    double distance_budget =
        distance * distance * static_cast<double>(face_vertices(exact.mesh->topology).size());
    // The budget takes rounding and noise for uncorrelated. They are, but only on average.
    constexpr int kMaxRounds = 8;
    constexpr double kSmaller = 0.95;
    Asset asset = problem.shell;
    CodedMesh& mesh = *asset.still();
    for (int round = 0; round < kMaxRounds; ++round) {
        mesh.positions = quantise_mean(exact.mesh->positions, {1.0, 1.0, 1.0}, distance_budget);
        mesh.transfer->matrix =
            quantise_mean(exact.mesh->transfer->matrix, problem.plane_weight, transfer_budget);
        MeshError error = measure_part(asset, 1, problem.bake, problem.spectrum);
        const bool transfer_good = error.transfer.total() <= transfer_error;
        const bool distance_good = error.geometry.rms() <= distance;
        if (transfer_good && distance_good) return {std::move(mesh), std::move(error)};
        if (!transfer_good) transfer_budget *= kSmaller;
        if (!distance_good) distance_budget *= kSmaller;
    }
    return exact;
}

}  // namespace paim
