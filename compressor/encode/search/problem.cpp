// Everything about a bake that the search for settings compares them on.
#include "compressor/encode/search/problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compressor/encode/data/bake_rows.h"
#include "compressor/encode/data/still_part.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/memory/target_memory.h"
#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/quantise/exceptions.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/search/held_positions.h"
#include "compressor/encode/search/transfer_encoder.h"
#include "compressor/encode/svd/vertex_motion.h"
#include "paim/codec/codecs.h"
#include "paim/format/bake/baked_part.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

namespace {

Albedo in_order(const Albedo& albedo, const std::vector<uint32_t>& old_vertex) {
    if (albedo.values.size() == 1) return albedo;
    Albedo ordered;
    ordered.values.clear();
    for (const uint32_t old : old_vertex) ordered.values.push_back(albedo.values[old]);
    return ordered;
}

// A still part of floats with vertices and triangles in cache order.
CodedMesh in_cache_order(CodedMesh mesh) {
    CacheOrder order = cache_order(mesh.topology);
    const auto reorder = [&](LowRank& matrix) {
        std::vector<float> values = matrix.mean.floats();
        reorder_planes(values, order.old_vertex);
        matrix.mean = std::move(values);
    };
    reorder(mesh.positions);
    reorder(mesh.transfer->matrix);
    mesh.albedo = in_order(mesh.albedo, order.old_vertex);
    mesh.topology = std::move(order.topology);
    return mesh;
}

// The asset without positions and transfer of the part that moves.
// order  of that part's vertices
Asset make_shell(const BakeReader& bake, const EncodeOptions& options, const TransferLayout& layout,
                 CacheOrder& order) {
    Asset shell;
    shell.vertex_order = VertexOrder::cache;
    shell.origin = bake.identity().origin;
    shell.frames_per_second = options.frames_per_second;
    shell.name = options.name;
    CodedMesh& mesh = shell.moving();
    mesh.topology = std::move(order.topology);
    mesh.albedo = in_order(bake.albedo(), order.old_vertex);
    mesh.layout = layout;
    mesh.positions.num_poses = bake.num_poses();
    mesh.root_motion = bake.identity().root_motion;
    mesh.num_following = new_number_of_first(bake.identity().num_following, order.old_vertex);
    if (auto still = still_part(bake, layout.in_bands)) {
        shell.parts.push_back(in_cache_order(std::move(*still)));
    }
    return shell;
}

// Light has some of every band, if little: no band may err without bounds.
std::vector<double> plane_weights(const TransferLayout& layout, const BandPower& spectrum) {
    std::vector<double> weights;
    for (uint32_t plane = 0; plane < layout.num_planes(); ++plane) {
        weights.push_back(std::max(1e-6, spectrum.weight(layout.input_band(plane))));
    }
    return weights;
}

// Mean square of a pose's transfer, as if all that is dropped were in the band that weighs most.
double transfer_energy(const EncodeProblem& problem) {
    double energy = 0.0, heaviest = 0.0;
    for (uint32_t l = 0; l < problem.layout.in_bands; ++l) {
        const double rms = problem.statistics.transfer_rms[l];
        const double weight = problem.spectrum.weight(l);
        energy += weight * (2.0 * l + 1.0) * problem.layout.channels * rms * rms;
        heaviest = std::max(heaviest, weight);
    }
    return heaviest > 0.0 ? energy / heaviest : energy;
}

// The errors of all components as floats.
AssetError measure_best(const EncodeProblem& problem) {
    CodedMesh best = problem.shell.moving();
    best.transfer = plain_transfer(
        float_matrix(problem.transfer, problem.transfer.num_components(), Precision::f32));
    AssetError error{
        {HeldPositions::best_surface(problem), problem.meter->transfer(best, problem.spectrum)},
        {}};
    if (problem.still_meter) {
        error.still = problem.still_meter->measure(*problem.shell.still(), problem.spectrum);
    }
    return error;
}

}  // namespace

EncodeProblem read_problem(const BakeReader& bake, const EncodeOptions& options,
                           const EncodeTarget& target, std::shared_ptr<SearchProgress> progress) {
    progress->begin("finding components", 0.35);
    const std::vector<SearchedCodec> codecs =
        searched_codecs(encoders_to_try(target.codec, options.precision));
    const PositionOutliers outliers = find_outliers(BakedPart(bake, 0));
    const EncodeSize streamed = with_outliers(encode_size(bake, options), outliers);
    uint32_t in_flight =
        choose_num_in_flight(streamed, options.memory_bytes, bake.directory().string());
    const BakeIdentity& identity = bake.identity();
    CacheOrder order = cache_order(bake.topology());
    EncodeProblem problem{.bake = bake,
                          .layout = identity.layout.with_bands(options.bands),
                          .spectrum = target.spectrum,
                          .statistics = bake.total_statistics(),
                          .progress = std::move(progress)};
    problem.shell = make_shell(bake, options, problem.layout, order);
    problem.predictor = PlanePredictor(problem.shell.moving().topology);
    problem.plane_weight = plane_weights(problem.layout, problem.spectrum);

    problem.smoother.emplace(problem.shell.moving().topology);
    problem.meter.emplace(problem.shell, 0, bake, outliers);
    if (problem.shell.still() != nullptr) problem.still_meter.emplace(problem.shell, 1, bake);
    problem.num_face_vertices = static_cast<uint32_t>(face_vertices(bake.topology()).size());
    problem.outliers = outliers;
    problem.file_outliers = outliers.reordered(order.old_vertex);

    const double asked = asked_error(target);
    HeldPositions positions(bake, outliers, target, in_flight);
    problem.progress->advance(0.15);
    problem.least_geometry_components = positions.least_components();
    const TransferRows transfer_rows(bake, problem.layout.in_bands);
    const TransferRows noise_rows(bake, problem.layout.in_bands, TransferRows::Content::noise);
    const PrincipalComponents transfer = principal_components(transfer_rows, in_flight);
    problem.progress->advance(0.3);
    const ComponentNoise noise =
        measure_component_noise(transfer_rows, noise_rows, problem.layout, transfer, in_flight);
    problem.progress->advance(0.5);
    const double num_values = static_cast<double>(identity.num_vertices) * bake.num_poses();
    TargetSize size{streamed, problem.layout.num_planes()};
    size.transfer_components = components_for(
        noise.num_above_noise,
        kDroppedShare * kDroppedShare * asked * asked * transfer_energy(problem) * num_values,
        [&](uint32_t k) { return noise.signal_of(static_cast<Eigen::Index>(k)); });
    size.codecs = codecs;
    do {
        size.geometry_components = positions.num_components();
        check_target_memory(size, searched_codecs(encoders_to_try("", options.precision)),
                            options.memory_bytes, bake.directory().string());
        in_flight = choose_target_in_flight(size, options.memory_bytes);
        positions.read(problem, order.old_vertex, in_flight);
    } while (positions.need_more(problem));
    problem.spare_bytes = options.memory_bytes - target_held_bytes(size);
    problem.unneeded_bytes = options.memory_bytes - target_memory_bytes(size);
    const Shrinkage shrinkage(noise);
    problem.transfer = read_factors(transfer_rows, transfer, size.transfer_components,
                                    options.noise == NoiseTreatment::shrink ? &shrinkage : nullptr,
                                    order.old_vertex, in_flight);

    problem.progress->advance(0.4);
    problem.best_achievable = measure_best(problem);
    for (uint32_t l = 0; l < identity.layout.in_bands; ++l) {
        problem.transfer_energy +=
            target.spectrum.weight(l) * problem.best_achievable.transfer.bands[l].baked;
    }
    return problem;
}

}  // namespace paim
