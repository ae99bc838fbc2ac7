// Stated errors, and energies of what limits leave out.
#include "player/inspect/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/format/container/metadata.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/band_power.h"
#include "paim/metrics/prefix_error.h"
#include "paim/metrics/singular_value_error.h"
#include "paim/sh/index.h"
#include "player/inspect/limit_errors.h"
#include "player/inspect/sample_times.h"

namespace paim::player {

namespace {

double root(double energy) {
    return energy > 0.0 ? std::sqrt(energy) : 0.0;
}

// Components need not be those of the largest singular values.
Truncation truncate(const LowRank& matrix, uint32_t limit) {
    LowRank kept;
    kept.num_components = std::min(limit, matrix.num_components);
    kept.singular_values = matrix.singular_values;
    kept.singular_indices = matrix.singular_indices;
    Truncation truncation{kept.num_components, matrix.num_components, {}, {}};
    const size_t num_values = matrix.singular_values.size();
    if (num_values == 0 ||
        (kept.num_components > 0 && kept.singular_index(kept.num_components - 1) >= num_values)) {
        return truncation;
    }
    truncation.theory_error = theory_error(kept);
    truncation.energy_error = energy_error(kept);
    return truncation;
}

// The largest diagonal of the body, of a few poses.
double largest_diagonal(const CodedMesh& mesh, std::span<const uint32_t> counted) {
    constexpr uint32_t kMostPoses = 16;
    PositionDecoder decoder;
    std::vector<float> planes;
    float diagonal = 0.0f;
    for (const double time : sample_times(mesh.num_poses(), kMostPoses)) {
        decoder.decode(mesh.positions, time, mesh.positions.num_usual_components(), planes);
        diagonal = std::max(diagonal, body_bounds(mesh, planes, counted).diagonal());
    }
    return double{diagonal};
}

}  // namespace

AccuracyMeter::AccuracyMeter(std::shared_ptr<const Asset> asset) : asset_(std::move(asset)) {
    PAIM_CHECK(asset_ != nullptr && !asset_->parts.empty());
    read_statement();
    add_up_transfer();
    add_up_positions();
}

void AccuracyMeter::read_statement() {
    try {
        const Metadata provenance(asset_->provenance_json.empty() ? "{}" : asset_->provenance_json,
                                  asset_->name);
        if (provenance.root().contains("bake_bands")) {
            bands_in_bake_ = provenance.integer("bake_bands", 1, sh::kMaxBands);
        }
        stated_ = read_error_statement(*asset_, asset_->name);
    } catch (const Error& error) {
        note_ = error.what();
    }
    const bool can_add =
        stated_ && (stated_->band_power == "flat" || stated_->band_power == "natural");
    band_power_ = can_add ? stated_->band_power : "flat";
    if (can_add) whole_transfer_ = stated_->value("transfer_total_error");
    if (stated_) whole_position_ = stated_->value("position_relative_rms");
}

void AccuracyMeter::add_up_transfer() {
    const CodedMesh& mesh = asset_->moving();
    const TransferLayout& layout = mesh.layout;
    const BandPower power = parse_band_power(band_power_, layout.in_bands);
    double decoded = 0.0;
    for (uint32_t band = 0; band < layout.in_bands; ++band) {
        std::vector<double> weights(layout.num_planes(), 0.0);
        for (uint32_t plane = 0; plane < weights.size(); ++plane) {
            if (layout.input_band(plane) == band) weights[plane] = power.weight(band);
        }
        ComponentEnergy energy = component_energy(mesh, Attribute::transfer, weights);
        decoded += energy.decoded;
        band_share_.push_back(energy.decoded);
        dropped_share_.push_back(std::move(energy.dropped));
    }
    // ‖x‖² of the bake, if the decoded transfer and its error are orthogonal (as prefix_errors()).
    const double deviation =
        whole_transfer_ ? stated_->value("transfer_deviation").value_or(0.0) : 0.0;
    const double norm = deviation < 1.0 ? decoded / (1.0 - deviation * deviation) : decoded;
    const auto divide = [norm](double& energy) { energy = energy > 0.0 ? energy / norm : 0.0; };
    for (double& share : band_share_) divide(share);
    for (std::vector<double>& shares : dropped_share_) {
        for (double& share : shares) divide(share);
    }
}

void AccuracyMeter::add_up_positions() {
    const CodedMesh& mesh = asset_->moving();
    const std::vector<uint32_t> counted = face_vertices(mesh.topology);
    const double num_places =
        static_cast<double>(counted.size()) * static_cast<double>(mesh.num_poses());
    const double diagonal = largest_diagonal(mesh, counted);
    for (const double energy : usual_position_energy(mesh).dropped) {
        const double rms = num_places > 0.0 ? root(energy / num_places) : 0.0;
        dropped_positions_.push_back(rms == 0.0 ? 0.0 : rms / diagonal);
    }
}

Accuracy AccuracyMeter::at(const DecodeLimits& limits) const {
    const CodedMesh& mesh = asset_->moving();
    const TransferModel& transfer = *mesh.transfer;
    Accuracy accuracy;
    accuracy.geometry = truncate(mesh.positions, limits.geometry_components);
    accuracy.transfer = truncate(transfer.matrix, limits.transfer_components);
    accuracy.bands = mesh.layout.with_bands(limits.bands).in_bands;
    accuracy.bands_in_file = mesh.layout.in_bands;
    accuracy.bands_in_bake = bands_in_bake_;
    double of_components = 0.0, of_bands = 0.0;
    for (uint32_t band = 0; band < mesh.layout.in_bands; ++band) {
        if (band < accuracy.bands) {
            of_components += dropped_share_[band][accuracy.transfer.used];
        } else {
            of_bands += band_share_[band];
        }
    }
    accuracy.transfer_dropped = root(of_components + of_bands);
    accuracy.bands_dropped = root(of_bands);
    accuracy.position_dropped = dropped_positions_[accuracy.geometry.used];
    const bool all_vertex_components = limits.vertex_components >= transfer.num_vertex_components();
    if (asset_->complete && whole_transfer_ && all_vertex_components) {
        accuracy.transfer_total = std::hypot(*whole_transfer_, accuracy.transfer_dropped);
    }
    if (asset_->complete && whole_position_) {
        accuracy.position_total = std::hypot(*whole_position_, accuracy.position_dropped);
    }
    accuracy.cost = frame_cost(mesh, limits);
    return accuracy;
}

}  // namespace paim::player
