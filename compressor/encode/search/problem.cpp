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
#include "compressor/encode/search/transfer_encoder.h"
#include "compressor/encode/svd/vertex_motion.h"
#include "paim/codec/codecs.h"
#include "paim/format/bake/baked_part.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

namespace {

// Components that are dropped beforehand may take this share of the error that is asked for.
constexpr double kDroppedShare = 0.15;

// Share of a vertex's motion that dropped components may take, where it is more than the distance
// that is asked for. What is left is √(1 − 0.19) = 90 % of the motion.
const double kLostByTarget = std::sqrt(0.19);

// The fewest components whose rest is at most `most`, in squares of singular values.
template <typename EnergyOf>
uint32_t components_for(uint32_t all, double most, const EnergyOf& energy_of) {
    double dropped = 0.0;
    uint32_t k = all;
    while (k > 0 && dropped + energy_of(k - 1) <= most) dropped += energy_of(--k);
    return k;
}

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
    Asset best = problem.shell;
    best.moving().positions =
        float_matrix(problem.geometry, problem.geometry.num_components(), Precision::f32);
    append_exceptions(problem.file_outliers, best.moving().positions);
    best.moving().transfer = plain_transfer(
        float_matrix(problem.transfer, problem.transfer.num_components(), Precision::f32));
    return measure_asset(best, problem.bake, problem.spectrum);
}

}  // namespace

EncodeProblem read_problem(const BakeReader& bake, const EncodeOptions& options,
                           const EncodeTarget& target) {
    const std::vector<SearchedCodec> codecs =
        searched_codecs(encoders_to_try(target.codec, options.precision));
    const PositionOutliers outliers = find_outliers(BakedPart(bake, 0));
    EncodeSize streamed = encode_size(bake, options);
    streamed.outlier_bytes = outliers.size_bytes();
    uint32_t in_flight =
        choose_num_in_flight(streamed, options.memory_bytes, bake.directory().string());
    const BakeIdentity& identity = bake.identity();
    CacheOrder order = cache_order(bake.topology());
    EncodeProblem problem{.bake = bake,
                          .layout = identity.layout.with_bands(options.bands),
                          .spectrum = target.spectrum,
                          .statistics = bake.total_statistics()};
    problem.shell = make_shell(bake, options, problem.layout, order);
    problem.predictor = PlanePredictor(problem.shell.moving().topology);
    problem.plane_weight = plane_weights(problem.layout, problem.spectrum);

    const double asked = target.transfer_error.value_or(0.001);
    const double num_values = static_cast<double>(identity.num_vertices) * bake.num_poses();
    const std::vector<uint32_t> counted = face_vertices(bake.topology());
    problem.num_face_vertices = static_cast<uint32_t>(counted.size());
    const double num_positions = static_cast<double>(counted.size()) * bake.num_poses();
    problem.outliers = outliers;
    problem.file_outliers = outliers.reordered(order.old_vertex);
    const GeometryRows geometry_rows(bake, outliers);
    const PrincipalComponents geometry = principal_components(geometry_rows, in_flight);
    const double diagonal = largest_diagonal(bake, outliers, counted);
    const double distance =
        diagonal * target.geometry_error.value_or(kGeometryPerTransferError * asked);
    problem.least_geometry_components =
        components_for_motion(geometry_rows, geometry, counted,
                              {kLostByTarget, std::max(distance, kInvisibleMotion * diagonal)});
    const TransferRows transfer_rows(bake, problem.layout.in_bands);
    const TransferRows noise_rows(bake, problem.layout.in_bands, TransferRows::Content::noise);
    const PrincipalComponents transfer = principal_components(transfer_rows, in_flight);
    const ComponentNoise noise =
        measure_component_noise(transfer_rows, noise_rows, problem.layout, transfer, in_flight);
    const double energy = transfer_energy(problem);
    TargetSize size{streamed, problem.layout.num_planes()};
    size.geometry_components = components_for(
        geometry.rank(), kDroppedShare * kDroppedShare * distance * distance * num_positions,
        [&](uint32_t k) { return geometry.singular_values[k] * geometry.singular_values[k]; });
    size.geometry_components =
        std::max(size.geometry_components, problem.least_geometry_components);
    size.transfer_components = components_for(
        noise.num_above_noise, kDroppedShare * kDroppedShare * asked * asked * energy * num_values,
        [&](uint32_t k) { return noise.signal_of(static_cast<Eigen::Index>(k)); });
    size.codecs = codecs;
    check_target_memory(size, searched_codecs(encoders_to_try("", options.precision)),
                        options.memory_bytes, bake.directory().string());
    problem.spare_bytes = options.memory_bytes - target_held_bytes(size);
    problem.unneeded_bytes = options.memory_bytes - target_memory_bytes(size);
    in_flight = choose_target_in_flight(size, options.memory_bytes);
    problem.geometry = read_factors(geometry_rows, geometry, size.geometry_components, nullptr,
                                    order.old_vertex, in_flight);
    const Shrinkage shrinkage(noise);
    problem.transfer = read_factors(transfer_rows, transfer, size.transfer_components,
                                    options.noise == NoiseTreatment::shrink ? &shrinkage : nullptr,
                                    order.old_vertex, in_flight);

    problem.best_achievable = measure_best(problem);
    for (uint32_t l = 0; l < identity.layout.in_bands; ++l) {
        problem.transfer_energy +=
            target.spectrum.weight(l) * problem.best_achievable.transfer.bands[l].baked;
    }
    return problem;
}

}  // namespace paim
