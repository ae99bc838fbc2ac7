// Error curves.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include "analysis/curves.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/singular_value_error.h"

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
uint64_t limited_size_bytes(const Asset& model, const DecodeLimits& limits) {
    Asset limited;
    limited.moving().topology.num_vertices = model.moving().topology.num_vertices;
    limited.moving().topology.triangles.resize(model.moving().topology.triangles.size());
    limited.moving().albedo = model.moving().albedo;
    limited.moving().layout = model.moving().layout;
    limited.moving().layout.in_bands = std::min(limits.bands, model.moving().layout.in_bands);
    limited.frames_per_second = model.frames_per_second;
    limited.name = model.name;
    limited.provenance_json = model.provenance_json;
    const auto limit_part = [](const LowRank& from, uint32_t num_planes, uint32_t limit) {
        LowRank to;
        to.num_points = from.num_points;
        to.num_planes = num_planes;
        to.num_poses = from.num_poses;
        to.num_components = std::min(limit, from.num_components);
        to.precision = from.precision;
        to.singular_values = from.singular_values;
        return to;
    };
    limited.moving().positions = limit_part(model.moving().positions, 3, limits.geometry_components);
    limited.moving().transfer->matrix =
        limit_part(model.moving().transfer->matrix, limited.moving().layout.num_planes(), limits.transfer_components);
    return paim_size_bytes(limited);
}

// all        how many there are
// spectrum   singular values, or what plays their part; size(value) of them are kept
// limit      the limit that a setting is
template <typename Size>
Curve plan_curve(const Asset& model, const char* name, const char* title, uint32_t all,
                 const std::vector<uint32_t>& others, std::span<const double> spectrum,
                 const Size& size, uint32_t DecodeLimits::*limit) {
    Curve curve{name, title, {}, {}, {}};
    for (uint32_t value = 0; value <= all; ++value) {
        curve.theory_errors.push_back(theory_error(spectrum, size(value)));
        curve.energy_errors.push_back(energy_error(spectrum, size(value)));
    }
    for (const uint32_t value : settings(all, others)) {
        CurvePoint point;
        point.value = value;
        point.all = value == all;
        point.limits.*limit = value;
        point.theory_error = curve.theory_errors[value];
        point.energy_error = curve.energy_errors[value];
        point.size_bytes = limited_size_bytes(model, point.limits);
        curve.points.push_back(std::move(point));
    }
    return curve;
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

std::vector<Curve> plan_curves(const BakeReader& bake, const Asset& model,
                               const std::vector<uint32_t>& components,
                               const std::vector<uint32_t>& bands) {
    const auto as_it_is = [](uint32_t value) { return value; };
    const auto squared = [](uint32_t value) { return value * value; };
    std::vector<Curve> curves;
    curves.push_back(
        plan_curve(model, "geometry_components", "Geometry components (all of the transfer)",
                   model.moving().positions.num_components, components, model.moving().positions.singular_values,
                   as_it_is, &DecodeLimits::geometry_components));
    curves.push_back(
        plan_curve(model, "transfer_components", "Transfer components (all of the geometry)",
                   model.moving().transfer->matrix.num_components, components, model.moving().transfer->matrix.singular_values,
                   as_it_is, &DecodeLimits::transfer_components));
    curves.push_back(plan_curve(model, "bands", "Bands (all components)", model.moving().layout.in_bands, bands,
                                coefficient_norms(bake), squared, &DecodeLimits::bands));
    return curves;
}

size_t num_points(const std::vector<Curve>& curves) {
    size_t count = 0;
    for (const Curve& curve : curves) count += curve.points.size();
    return count;
}

}  // namespace paim
