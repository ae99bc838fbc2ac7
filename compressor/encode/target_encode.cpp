// From an error to a file: the cheapest .paim that meets a target.
#include "compressor/encode/target_encode.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

#include "compressor/encode/material.h"
#include "compressor/encode/part_search.h"
#include "compressor/encode/provenance.h"
#include "compressor/encode/trim_bands.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/paim_packer.h"
#include "paim/metrics/rates.h"

namespace paim {

namespace {

// What both parts shall meet. Transfer errors are relative, distances in scene units.
struct Targets {
    double transfer = 0.0;
    double geometry = 0.0;
};

// Sum of squares that quantisation and truncation may add to what the best of the bake already errs.
double transfer_budget(const Material& material, double target) {
    const double floor = material.floor.transfer.total();
    return std::max(0.0, (target * target - floor * floor) * material.transfer_energy);
}

double geometry_budget(const Material& material, double target) {
    return target * target * static_cast<double>(material.geometry.num_points) *
           material.bake.num_poses();
}

// A way to code both parts, and the steps that it can be made finer or coarser with.
struct Coding {
    Quantiser geometry, transfer;
};

class Encoder {
  public:
    Encoder(const Material& material, const EncodeOptions& options, const EncodeTarget& target)
        : material_(material), options_(options), target_(target) {}

    // Errors: threshold exceeded.
    Coding choose(const Targets& targets, TargetSummary& summary) const {
        Coding coding;
        const std::vector<double> distances(3, 1.0);
        const auto geometry = cheapest_part(
            material_.geometry, distances, geometry_budget(material_, targets.geometry),
            material_.geometry.num_components(), material_.predictor);
        if (!geometry) {
            throw Error(
                ExitCode::threshold_exceeded,
                fmt::format("geometry: an RMS distance of {:.3g} needs more than the 16 bits "
                            "that a value has",
                            targets.geometry));
        }
        coding.geometry = geometry->quantiser;
        const auto transfer = cheapest_part(material_.transfer, material_.plane_weight,
                                            transfer_budget(material_, targets.transfer),
                                            most_components(), material_.predictor);
        if (!transfer) {
            throw Error(
                ExitCode::threshold_exceeded,
                fmt::format("transfer: {:.3g} % cannot be met within {} multiply-adds a vertex",
                            100.0 * targets.transfer, *target_.decode_cost));
        }
        coding.transfer = transfer->quantiser;
        Candidate candidate;
        candidate.codec = "svd";
        candidate.bands = material_.layout.bands;
        candidate.components = transfer->matrix.num_components;
        candidate.bytes = transfer->bytes;
        candidate.multiply_adds = static_cast<uint32_t>(
            svd_transfer_cost(material_.layout, candidate.components, true).per_vertex());
        candidate.chosen = true;
        summary.candidates = {candidate};
        return coding;
    }

    // The model of a coding, nothing measured.
    Model build(const Coding& coding) const {
        Model model = material_.frame;
        model.geometry = quantise(material_.geometry, coding.geometry);
        model.transfer = quantise(material_.transfer, coding.transfer);
        trim_bands(model);
        return model;
    }

    // Makes steps finer until both errors, measured, are within the targets, and coarser where there is
    // room. Errors: threshold exceeded.
    Model refine(Coding coding, const Targets& targets, ModelError& error) const {
        constexpr int kMostRounds = 8;
        constexpr double kRoom = 0.985;  // below this share of a target a coarser step is tried
        std::optional<Model> best;
        for (int round = 0; round < kMostRounds; ++round) {
            Model model = build(coding);
            const ModelError measured = material_.measure(model);
            const double transfer = measured.transfer.total();
            const double geometry = measured.geometry.rms();
            const bool good = transfer <= targets.transfer && geometry <= targets.geometry;
            if (good) {
                best = std::move(model);
                error = measured;
            }
            const bool room =
                transfer < kRoom * targets.transfer || geometry < kRoom * targets.geometry;
            if (good && (!room || round >= 3)) break;
            if (best && !good) break;  // a step too far
            const double floor = material_.floor.transfer.total();
            adjust(coding.transfer.step, std::hypot(transfer, 0.0), targets.transfer, floor);
            adjust(coding.geometry.step, geometry, targets.geometry, 0.0);
        }
        if (!best) {
            throw Error(
                ExitCode::threshold_exceeded,
                fmt::format("{}: no steps were found that meet {:.3g} % of the transfer and a "
                            "distance of {:.3g}",
                            material_.bake.directory().string(), 100.0 * targets.transfer,
                            targets.geometry));
        }
        return std::move(*best);
    }

  private:
    // Errors above the floor grow about as the step does.
    static void adjust(double& step, double error, double target, double floor) {
        const double now = error * error - floor * floor;
        const double wanted = target * target - floor * floor;
        if (now > 0.0 && wanted > 0.0) {
            step *= std::clamp(0.997 * std::sqrt(wanted / now), 0.5, 1.25);
        }
    }

    // Of the transfer, within the decode cost.
    uint32_t most_components() const {
        const uint32_t all = material_.transfer.num_components();
        if (!target_.decode_cost) return all;
        uint32_t most = all;
        while (most > 0 && svd_transfer_cost(material_.layout, most, true).per_vertex() >
                               *target_.decode_cost) {
            --most;
        }
        return most;
    }

    const Material& material_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
};

void check_reachable(const Material& material, double target) {
    const TransferError& floor = material.floor.transfer;
    if (floor.total() < target) return;
    const std::string bake = material.bake.directory().string();
    if (floor.missing_bands > floor.error) {
        throw Error(
            ExitCode::threshold_exceeded,
            fmt::format("{}: a transfer error of {:.3g} % is asked for, but its {} bands leave "
                        "{:.3g} % of the light of this spectrum out: the best is {:.3g} %; bake "
                        "with more --bands",
                        bake, 100.0 * target, material.bake.identity().layout.bands,
                        100.0 * floor.missing_bands, 100.0 * floor.total()));
    }
    if (material.layout.bands < material.bake.identity().layout.bands) {
        throw Error(
            ExitCode::threshold_exceeded,
            fmt::format("{}: a transfer error of {:.3g} % is asked for, but {} of its {} bands "
                        "leave {:.3g} %: keep more --bands",
                        bake, 100.0 * target, material.layout.bands,
                        material.bake.identity().layout.bands, 100.0 * floor.total()));
    }
    throw Error(
        ExitCode::threshold_exceeded,
        fmt::format("{}: a transfer error of {:.3g} % is asked for, but the bake's noise leaves "
                    "{:.3g} % at best: bake with more --rays",
                    bake, 100.0 * target, 100.0 * floor.total()));
}

Targets targets_of(const Material& material, const EncodeTarget& target, double transfer_error) {
    const double relative =
        target.geometry_error.value_or(kGeometryPerTransferError * transfer_error);
    return {transfer_error, relative * material.floor.geometry.diagonal};
}

}  // namespace

const Candidate& TargetSummary::chosen() const {
    const auto found = std::find_if(candidates.begin(), candidates.end(),
                                    [](const Candidate& candidate) { return candidate.chosen; });
    PAIM_CHECK(found != candidates.end());
    return *found;
}

TargetSummary encode_to_target(const BakeReader& bake, const EncodeOptions& options,
                               const EncodeTarget& target, const std::filesystem::path& output,
                               const std::function<void(const char*)>& on_step) {
    const auto say = [&](const char* step) {
        if (on_step) on_step(step);
    };
    remove_abandoned_files(std::filesystem::absolute(output).parent_path(),
                           output.filename().string() + ".");
    say("reading the bake and finding its components");
    const Material material = read_material(bake, options, target);
    TargetSummary summary;
    summary.floor = material.floor.transfer.total();
    summary.num_vertices = material.geometry.num_points;
    summary.num_poses = bake.num_poses();
    PAIM_CHECK(target.transfer_error.has_value());
    check_reachable(material, *target.transfer_error);
    const Targets targets = targets_of(material, target, *target.transfer_error);
    summary.transfer_target = targets.transfer;
    summary.geometry_target = targets.geometry;

    const Encoder encoder(material, options, target);
    say("comparing ways to code it");
    const Coding coding = encoder.choose(targets, summary);
    say("quantising and measuring");
    Model model = encoder.refine(coding, targets, summary.error);
    nlohmann::ordered_json provenance =
        nlohmann::ordered_json::parse(bake_provenance(bake.identity(), material.statistics));
    provenance["noise"] = "shrink";
    provenance["measured"] =
        nlohmann::ordered_json::parse(error_statement_json(summary.error, target.spectrum));
    model.provenance_json = provenance.dump();
    say("packing");
    const PackedFile file(model);
    file.write(output);
    summary.size_bytes = file.size_bytes();
    summary.geometry_components = model.geometry.num_components;
    return summary;
}

}  // namespace paim
