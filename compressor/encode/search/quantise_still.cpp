// The still part as integers.
#include "compressor/encode/search/quantise_still.h"

#include <algorithm>
#include <cmath>
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

QuantisedStill quantise_still(const EncodeProblem& problem, const Targets& targets) {
    QuantisedStill exact = exact_still(problem);
    if (!exact.mesh) return exact;
    const TransferError& best = exact.error->transfer;
    double energy = 0.0;
    for (uint32_t l = 0; l < best.bands.size(); ++l) {
        energy += problem.spectrum.weight(l) * best.bands[l].baked;
    }
    const double room = targets.transfer * targets.transfer - best.total() * best.total();
    double transfer_budget = std::max(0.0, room) * energy;
    const double distance = targets.surface.distance;
    double distance_budget =
        distance * distance * static_cast<double>(face_vertices(exact.mesh->topology).size());
    // The budget takes rounding and noise for uncorrelated. They are, but only on average. It does
    // not know what edges and normals need.
    constexpr int kMaxRounds = 12;
    constexpr double kSmaller = 0.95;
    Asset asset = problem.shell;
    CodedMesh& mesh = *asset.still();
    for (int round = 0; round < kMaxRounds; ++round) {
        mesh.positions = quantise_mean(exact.mesh->positions, {1.0, 1.0, 1.0}, distance_budget);
        mesh.transfer->matrix =
            quantise_mean(exact.mesh->transfer->matrix, problem.plane_weight, transfer_budget);
        MeshError error = problem.still_meter->measure(mesh, problem.spectrum);
        const bool transfer_good =
            error.transfer.total() <= targets.transfer &&
            error.transfer.worst_vertex_error_to_bake <= targets.worst_vertex;
        const double over = excess(error, targets.surface);
        if (transfer_good && over <= 1.0) return {std::move(mesh), std::move(error)};
        if (!transfer_good) transfer_budget *= kSmaller;
        if (!(over <= 1.0)) {
            constexpr double kAim = 0.97, kFinest = 0.1;
            const double smaller = std::clamp(kAim / over, kFinest, std::sqrt(kSmaller));
            distance_budget *= smaller * smaller;
        }
    }
    return exact;
}

}  // namespace paim
