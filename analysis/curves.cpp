// Error curves.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry, 2012
#include "analysis/curves.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>

#include "paim/codec/svd_decoder.h"
#include "paim/format/paim_file.h"
#include "paim/metrics/image_error.h"
#include "paim/metrics/spectrum.h"

namespace paim {

namespace {

// all, then the others that are less, largest first, each once.
std::vector<uint32_t> settings(uint32_t all, const std::vector<uint32_t>& others) {
    std::set<uint32_t, std::greater<>> values{all};
    for (const uint32_t value : others) {
        if (value < all) values.insert(value);
    }
    return {values.begin(), values.end()};
}

// The size of the model's file if it kept only this.
uint64_t limited_size_bytes(const Model& model, const DecodeLimits& limits) {
    Model limited;
    limited.topology.num_vertices = model.topology.num_vertices;
    limited.topology.triangles.resize(model.topology.triangles.size());
    limited.albedo = model.albedo;
    limited.layout = model.layout;
    limited.layout.bands = std::min(limits.bands, model.layout.bands);
    limited.frames_per_second = model.frames_per_second;
    limited.name = model.name;
    limited.provenance_json = model.provenance_json;
    const auto limit_part = [](const LowRankMatrix& from, uint32_t num_planes, uint32_t limit) {
        LowRankMatrix to;
        to.num_vertices = from.num_vertices;
        to.num_planes = num_planes;
        to.num_poses = from.num_poses;
        to.num_components = std::min(limit, from.num_components);
        to.precision = from.precision;
        to.singular_values = from.singular_values;
        return to;
    };
    limited.geometry = limit_part(model.geometry, 3, limits.geometry_components);
    limited.transfer =
        limit_part(model.transfer, limited.layout.num_planes(), limits.transfer_components);
    return paim_size_bytes(limited);
}

// Renders and times all measured poses at this setting.
CurvePoint measure(const Model& model, const Stage& stage, const DecodeLimits& limits) {
    using Clock = std::chrono::steady_clock;
    const SvdDecoder decoder(model);
    CurvePoint point;
    std::vector<ImageError> errors(stage.lights().size());
    std::vector<double> times_ms;
    DecodedPose pose;
    decoder.decode(0.0, limits, pose);  // takes the memory, so that the clock measures the work
    for (size_t j = 0; j < stage.poses().size(); ++j) {
        const auto start = Clock::now();
        decoder.decode(stage.poses()[j], limits, pose);
        times_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
        const std::vector<Image> images = stage.render_pose(pose);
        for (size_t light = 0; light < images.size(); ++light) {
            errors[light].add(compare_images(images[light], stage.reference(j)[light]));
        }
        if (j == 0) point.images = images;
    }
    for (const ImageError& error : errors) point.visual_error.push_back(error.visual_error());
    std::nth_element(times_ms.begin(), times_ms.begin() + times_ms.size() / 2, times_ms.end());
    point.decode_ms = times_ms[times_ms.size() / 2];
    point.size_bytes = limited_size_bytes(model, limits);
    return point;
}

}  // namespace

std::vector<double> coefficient_norms(const BakeReader& bake) {
    const TransferLayout layout = bake.identity().layout;
    const size_t num_vertices = bake.identity().num_vertices;
    std::vector<double> energies(layout.num_coefficients(), 0.0);
    std::vector<float> plane(num_vertices);
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        for (uint32_t j = 0; j < layout.num_planes(); ++j) {
            bake.read_transfer_rows(p, j * num_vertices, num_vertices, plane.data());
            double sum = 0.0;
            for (const float t : plane) sum += static_cast<double>(t) * t;
            energies[j % layout.num_coefficients()] += sum;
        }
    }
    for (double& energy : energies) energy = std::sqrt(energy);
    return energies;
}

std::vector<Curve> measure_curves(const BakeReader& bake, const Model& model, const Stage& stage,
                                  const std::vector<uint32_t>& components,
                                  const std::vector<uint32_t>& bands,
                                  const std::function<void()>& on_point) {
    std::vector<Curve> curves{
        {"geometry_components", "Geometry components (all of the transfer)", {}},
        {"transfer_components", "Transfer components (all of the geometry)", {}},
        {"bands", "Bands (all components)", {}}};

    const auto measure_components = [&](const LowRankMatrix& matrix, auto member, Curve& curve) {
        for (const uint32_t k : settings(matrix.num_components, components)) {
            DecodeLimits limits;
            limits.*member = k;
            CurvePoint point = measure(model, stage, limits);
            point.value = k;
            point.all = k == matrix.num_components;
            point.theory_error = theory_error(matrix.singular_values, k);
            point.energy_error = energy_error(matrix.singular_values, k);
            curve.points.push_back(std::move(point));
            on_point();
        }
    };
    measure_components(model.geometry, &DecodeLimits::geometry_components, curves[0]);
    measure_components(model.transfer, &DecodeLimits::transfer_components, curves[1]);

    const std::vector<double> norms = coefficient_norms(bake);
    for (const uint32_t b : settings(model.layout.bands, bands)) {
        DecodeLimits limits;
        limits.bands = b;
        CurvePoint point = measure(model, stage, limits);
        point.value = b;
        point.all = b == model.layout.bands;
        point.theory_error = theory_error(norms, b * b);
        point.energy_error = energy_error(norms, b * b);
        curves[2].points.push_back(std::move(point));
        on_point();
    }
    return curves;
}

size_t num_curve_points(const Model& model, const std::vector<uint32_t>& components,
                        const std::vector<uint32_t>& bands) {
    return settings(model.geometry.num_components, components).size() +
           settings(model.transfer.num_components, components).size() +
           settings(model.layout.bands, bands).size();
}

}  // namespace paim
