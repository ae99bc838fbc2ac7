// Everything about a bake that ways to code it are compared on.
#include "compressor/encode/search/problem.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compressor/encode/data/bake_rows.h"
#include "compressor/encode/data/playable_scenery.h"
#include "compressor/encode/memory/memory_plan.h"
#include "compressor/encode/memory/target_memory.h"
#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/quantise/float_part.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

namespace {

// Components that are dropped beforehand may take this share of the error that is asked for.
constexpr double kDroppedShare = 0.15;

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

Scenery in_cache_order(Scenery scenery) {
    CacheOrder order = cache_order(scenery.topology);
    const auto reorder = [&](StillPlanes& planes) {
        std::vector<float> values = planes.floats();
        reorder_planes(values, order.old_vertex);
        planes = std::move(values);
    };
    reorder(scenery.positions);
    reorder(scenery.transfer);
    scenery.albedo = in_order(scenery.albedo, order.old_vertex);
    scenery.topology = std::move(order.topology);
    return scenery;
}

// Largest diagonal of a pose's bounding box.
double largest_diagonal(const BakeReader& bake) {
    GeometryError measured;
    std::vector<float> positions(size_t{3} * bake.identity().num_vertices);
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        bake.read_position_rows(p, 0, positions.size(), positions.data());
        measured.add(positions, positions, p);
    }
    return measured.diagonal;
}

}  // namespace

EncodeProblem read_problem(const BakeReader& bake, const EncodeOptions& options,
                           const EncodeTarget& target) {
    uint32_t in_flight = choose_num_in_flight(encode_size(bake, options), options.memory_bytes,
                                              bake.directory().string());
    const BakeIdentity& identity = bake.identity();
    EncodeProblem problem{bake,
                          identity.layout,
                          target.spectrum,
                          bake.total_statistics(),
                          {},
                          {},
                          {},
                          {},
                          {},
                          {},
                          0.0,
                          0,
                          0};
    problem.layout.bands = std::min(options.bands, identity.layout.bands);
    CacheOrder order = cache_order(bake.topology());
    Model& frame = problem.frame;
    frame.topology = std::move(order.topology);
    frame.vertex_order = VertexOrder::cache;
    frame.albedo = in_order(bake.albedo(), order.old_vertex);
    frame.layout = problem.layout;
    frame.origin = identity.origin;
    frame.frames_per_second = options.frames_per_second;
    frame.name = options.name;
    frame.scenery = in_cache_order(playable_scenery(bake, problem.layout.bands));
    problem.predictor = PlanePredictor(frame.topology);
    for (uint32_t plane = 0; plane < problem.layout.num_planes(); ++plane) {
        const double weight = target.spectrum.weight(problem.layout.band_of_plane(plane));
        // Light has some of every band, if little: no band may err without bounds.
        problem.plane_weight.push_back(std::max(1e-6, weight));
    }

    const double asked = target.transfer_error.value_or(0.001);
    const double num_values = static_cast<double>(identity.num_vertices) * bake.num_poses();
    const GeometryRows geometry_rows(bake);
    const PrincipalComponents geometry = principal_components(geometry_rows, in_flight);
    const double distance =
        largest_diagonal(bake) * target.geometry_error.value_or(kGeometryPerTransferError * asked);
    const TransferRows transfer_rows(bake, problem.layout.bands);
    const TransferRows noise_rows(bake, problem.layout.bands, TransferRows::Content::noise);
    const PrincipalComponents transfer = principal_components(transfer_rows, in_flight);
    const ComponentNoise noise =
        measure_component_noise(transfer_rows, noise_rows, problem.layout, transfer, in_flight);
    // As if all that is dropped were in the band that weighs most.
    double energy = 0.0, heaviest = 0.0;
    for (uint32_t l = 0; l < problem.layout.bands; ++l) {
        const double rms = problem.statistics.transfer_rms[l];
        const double weight = target.spectrum.weight(l);
        energy += weight * (2.0 * l + 1.0) * problem.layout.channels * rms * rms;
        heaviest = std::max(heaviest, weight);
    }
    if (heaviest > 0.0) energy /= heaviest;
    TargetSize size{encode_size(bake, options), problem.layout.num_planes()};
    size.geometry_components = components_for(
        geometry.rank(), kDroppedShare * kDroppedShare * distance * distance * num_values,
        [&](uint32_t k) { return geometry.singular_values[k] * geometry.singular_values[k]; });
    size.transfer_components = components_for(
        noise.num_above_noise, kDroppedShare * kDroppedShare * asked * asked * energy * num_values,
        [&](uint32_t k) { return noise.signal_of(static_cast<Eigen::Index>(k)); });
    size.clusters = target.codec != CodecChoice::svd && is_integer(options.precision);
    check_target_memory(size, options.memory_bytes, bake.directory().string());
    problem.spare_bytes = options.memory_bytes - target_held_bytes(size);
    problem.unneeded_bytes = options.memory_bytes - target_memory_bytes(size);
    in_flight = choose_target_in_flight(size, options.memory_bytes);
    problem.geometry = read_factors(geometry_rows, geometry, size.geometry_components, nullptr,
                                    order.old_vertex, in_flight);
    const Shrinkage shrinkage(noise);
    problem.transfer = read_factors(transfer_rows, transfer, size.transfer_components,
                                    options.noise == NoiseTreatment::shrink ? &shrinkage : nullptr,
                                    order.old_vertex, in_flight);

    Model floor = problem.frame;
    floor.geometry =
        float_part(problem.geometry, problem.geometry.num_components(), Precision::f32);
    floor.transfer =
        float_part(problem.transfer, problem.transfer.num_components(), Precision::f32);
    problem.floor = problem.measure(floor);
    for (uint32_t l = 0; l < identity.layout.bands; ++l) {
        problem.transfer_energy +=
            target.spectrum.weight(l) * problem.floor.transfer.bands[l].baked;
    }
    return problem;
}

}  // namespace paim
