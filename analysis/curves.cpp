// Error curves.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include "analysis/curves.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "paim/codec/cut.h"
#include "paim/format/paim/paim_write.h"
#include "paim/metrics/singular_value_error.h"

namespace paim {

namespace {

// `all`, then those of the others that are smaller, in descending order without repetitions.
std::vector<uint32_t> settings(uint32_t all, const std::vector<uint32_t>& others) {
    std::set<uint32_t, std::greater<>> values{all};
    for (const uint32_t value : others) {
        if (value < all) values.insert(value);
    }
    return {values.begin(), values.end()};
}

// Size of the asset's file within the limits.
uint64_t limited_size_bytes(const Asset& asset, const DecodeLimits& limits) {
    Asset limited = asset;
    keep_within(limits, limited);
    return paim_size_bytes(limited);
}

// all        number of components or bands
// spectrum   singular values, or norms of coefficients; the first size(value) of them are kept
// limit      the member of DecodeLimits that a setting sets
template <typename Size>
Curve plan_curve(const Asset& asset, const char* name, const char* title, uint32_t all,
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
        point.size_bytes = limited_size_bytes(asset, point.limits);
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

std::vector<Curve> plan_curves(const BakeReader& bake, const Asset& asset,
                               const std::vector<uint32_t>& components,
                               const std::vector<uint32_t>& bands) {
    const auto as_it_is = [](uint32_t value) { return value; };
    const auto coefficients = [](uint32_t value) {
        return static_cast<uint32_t>(sh::num_coefficients(static_cast<int>(value)));
    };
    const CodedMesh& mesh = asset.moving();
    std::vector<Curve> curves;
    curves.push_back(
        plan_curve(asset, "geometry_components", "Geometry components (all of the transfer)",
                   mesh.positions.num_components, components, mesh.positions.singular_values,
                   as_it_is, &DecodeLimits::geometry_components));
    curves.push_back(plan_curve(
        asset, "transfer_components", "Transfer components (all of the geometry)",
        mesh.transfer->matrix.num_components, components, mesh.transfer->matrix.singular_values,
        as_it_is, &DecodeLimits::transfer_components));
    curves.push_back(plan_curve(asset, "bands", "Bands (all components)", mesh.layout.in_bands,
                                bands, coefficient_norms(bake), coefficients,
                                &DecodeLimits::bands));
    return curves;
}

size_t num_points(const std::vector<Curve>& curves) {
    size_t count = 0;
    for (const Curve& curve : curves) count += curve.points.size();
    return count;
}

}  // namespace paim
