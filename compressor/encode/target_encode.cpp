// From an error to a file: the cheapest .paim that meets a target.
#include "compressor/encode/target_encode.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compressor/encode/float_part.h"
#include "compressor/encode/material.h"
#include "compressor/encode/part_search.h"
#include "compressor/encode/provenance.h"
#include "compressor/encode/transfer_search.h"
#include "compressor/encode/trim_bands.h"
#include "paim/base/check.h"
#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/format/paim_packer.h"
#include "paim/metrics/rates.h"

namespace paim {

namespace {

[[noreturn]] void throw_missed(const std::string& message) {
    throw Error(ExitCode::threshold_exceeded, message);
}

// What both parts shall meet. Transfer errors are relative, distances in scene units.
struct Targets {
    double transfer = 0.0;
    double geometry = 0.0;
};

Targets targets_of(const Material& material, const EncodeTarget& target, double transfer_error) {
    const double relative =
        target.geometry_error.value_or(kGeometryPerTransferError * transfer_error);
    return {transfer_error, relative * material.floor.geometry.diagonal};
}

// A way to code both parts, with the steps that it can be made finer or coarser with.
struct Coding {
    Quantiser geometry;
    Precision geometry_precision = Precision::i16;
    uint64_t geometry_bytes = 0;
    TransferCoding transfer;
};

class Encoder {
  public:
    Encoder(const Material& material, const EncodeOptions& options, const EncodeTarget& target)
        : material_(material),
          options_(options),
          target_(target),
          search_(material, options, target) {}

    // The best coding that should meet the targets; nothing if none does. Leaves what was compared in
    // `candidates`.
    std::optional<Coding> choose(const Targets& targets, std::vector<Candidate>& candidates,
                                 std::string& reason) {
        Coding coding;
        if (!choose_geometry(targets.geometry, coding)) {
            reason = fmt::format(
                "an RMS distance of {:.3g} needs positions of more than 16 bits: allow a larger "
                "--geometry-error, or use --precision f32",
                targets.geometry);
            return std::nullopt;
        }
        const std::vector<TransferCoding> codings =
            search_.codings(transfer_budget(targets.transfer));
        std::optional<uint64_t> most;
        if (target_.size_bytes && target_.transfer_error) {
            const uint64_t rest = coding.geometry_bytes + frame_bytes();
            most = *target_.size_bytes > rest ? *target_.size_bytes - rest : 0;
        }
        const TransferCoding* best = best_coding(codings, target_.preference, most);
        // What seems too large may still fit once it is squeezed.
        if (best == nullptr) best = best_coding(codings, Preference::size, {});
        if (best == nullptr) {
            reason = fmt::format("a transfer error of {:.3g} % ", 100.0 * targets.transfer);
            if (target_.decode_cost) {
                reason += fmt::format("cannot be met with {} multiply-adds a vertex",
                                      *target_.decode_cost);
            } else if (target_.codec == CodecChoice::cpca) {
                reason +=
                    "cannot be met by clusters of as many components as are tried: use "
                    "--codec auto";
            } else {
                reason += "needs values of more than 16 bits: use --precision f32";
            }
            return std::nullopt;
        }
        candidates.clear();
        for (const TransferCoding& one : codings) {
            candidates.push_back(one.candidate);
            candidates.back().chosen = &one == best;
        }
        coding.transfer = *best;
        return coding;
    }

    // Makes steps finer until both errors, measured, are within the targets, and coarser where there
    // is room. Nothing if no step was found.
    std::optional<Model> refine(Coding coding, const Targets& targets, ModelError& error) const {
        constexpr int kMostRounds = 8;
        constexpr double kRoom = 0.985;  // below this share of a target a coarser step is tried
        const double floor = material_.floor.transfer.total();
        std::optional<Model> best;
        for (int round = 0; round < kMostRounds; ++round) {
            Model model;
            try {
                model = build(coding);
            } catch (const Error& error_of_step) {
                // Finer than values of 16 bits can be: what there is, is the best there is.
                if (error_of_step.code() != ExitCode::unsupported) throw;
                break;
            }
            const ModelError measured = material_.measure(model);
            const double transfer = measured.transfer.total();
            const double geometry = measured.geometry.rms();
            const bool good = transfer <= targets.transfer && geometry <= targets.geometry;
            if (best && !good) break;  // a step too far
            if (good) {
                best = std::move(model);
                error = measured;
            }
            const bool room =
                transfer < kRoom * targets.transfer || geometry < kRoom * targets.geometry;
            if (good && (!room || round >= 3)) break;
            const bool coarser = good;
            adjust(coding.transfer.quantiser, coding.transfer.precision, coarser, transfer,
                   targets.transfer, floor);
            adjust(coding.geometry, coding.geometry_precision, coarser, geometry, targets.geometry,
                   0.0);
        }
        return best;
    }

  private:
    // Squares that truncation and quantisation may add to what the best of the bake already errs.
    double transfer_budget(double target) const {
        const double floor = material_.floor.transfer.total();
        return std::max(0.0, (target * target - floor * floor) * material_.transfer_energy);
    }

    bool choose_geometry(double target, Coding& coding) const {
        const std::vector<double> alike(3, 1.0);
        const Scores& scores = material_.geometry;
        const double most =
            target * target * static_cast<double>(scores.num_points) * scores.num_poses();
        if (is_integer(options_.precision)) {
            auto choice = cheapest_part(
                part_choices(scores, alike, most, scores.num_components(), material_.predictor));
            if (!choice) return false;
            coding.geometry = std::move(choice->quantiser);
            coding.geometry_bytes = choice->bytes;
            return true;
        }
        const std::vector<double> tails = tail_errors(scores, alike);
        uint32_t k = 0;
        while (k + 1 < tails.size() && tails[k] > most) ++k;
        coding.geometry = {1.0, k, alike};
        coding.geometry_precision = options_.precision;
        const uint64_t value = options_.precision == Precision::f16 ? 2 : 4;
        coding.geometry_bytes = scores.mean.size() * (4 + k * value);
        return true;
    }

    // Triangles, colours, table: about.
    uint64_t frame_bytes() const {
        return 2 * material_.frame.topology.triangles.size() + 4096 +
               material_.frame.scenery.transfer.values.size_bytes();
    }

    Model build(const Coding& coding) const {
        Model model = material_.frame;
        model.geometry = is_integer(coding.geometry_precision)
                             ? quantise(material_.geometry, coding.geometry)
                             : float_part(material_.geometry, coding.geometry.num_components,
                                          coding.geometry_precision);
        coding.transfer.apply(material_, model);
        trim_bands(model);
        return model;
    }

    // Errors above the floor grow about as the step does. Floats have no step: one more component.
    static void adjust(Quantiser& quantiser, Precision precision, bool coarser, double error,
                       double target, double floor) {
        if (!is_integer(precision)) {
            if (!coarser && error > target) ++quantiser.num_components;
            return;
        }
        const double now = error * error - floor * floor;
        const double wanted = target * target - floor * floor;
        if (now > 0.0 && wanted > 0.0) {
            quantiser.step *= std::clamp(0.997 * std::sqrt(wanted / now), 0.5, 1.25);
        }
    }

    const Material& material_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    TransferSearch search_;
};

void check_reachable(const Material& material, double target) {
    const TransferError& floor = material.floor.transfer;
    if (floor.total() < target) return;
    const std::string asked = fmt::format("{}: a transfer error of {:.3g} % is asked for, but ",
                                          material.bake.directory().string(), 100.0 * target);
    const uint32_t baked = material.bake.identity().layout.bands;
    if (floor.missing_bands > floor.error) {
        throw_missed(fmt::format(
            "{}its {} bands leave out {:.3g} % of what light of this spectrum shows: the best is "
            "{:.3g} %; bake with more --bands",
            asked, baked, 100.0 * floor.missing_bands, 100.0 * floor.total()));
    }
    if (material.layout.bands < baked) {
        throw_missed(fmt::format("{}{} of its {} bands leave {:.3g} % at best: keep more --bands",
                                 asked, material.layout.bands, baked, 100.0 * floor.total()));
    }
    throw_missed(fmt::format("{}the bake's noise leaves {:.3g} % at best: bake with more --rays",
                             asked, 100.0 * floor.total()));
}

uint64_t multiply_adds(const Model& model) {
    const VertexClusters& clusters = model.clusters;
    const FrameCost cost =
        clusters.empty() ? svd_transfer_cost(model.layout, model.transfer.num_components, true)
                         : clustered_transfer_cost(model.layout, clusters.num_clusters,
                                                   clusters.num_components, 0, true);
    return cost.per_vertex();
}

// A file that is ready to be written.
struct Result {
    Model model;
    PackedFile file;
};

class TargetEncoder {
  public:
    TargetEncoder(const Material& material, const EncodeOptions& options,
                  const EncodeTarget& target, TargetSummary& summary)
        : material_(material),
          noise_(options.noise),
          target_(target),
          summary_(summary),
          encoder_(material, options, target) {}

    // The file of this error. Nothing, with the reason, if there is none.
    std::optional<Result> meet(double transfer_error, std::string& reason) {
        const Targets targets = targets_of(material_, target_, transfer_error);
        const std::string bake = material_.bake.directory().string() + ": ";
        // What is chosen by estimates may leave its integers too little room once it is measured:
        // then something of a smaller error by estimate.
        std::optional<Model> model;
        for (const double margin : {1.0, 0.97, 0.93, 0.88}) {
            const auto coding = encoder_.choose({margin * targets.transfer, targets.geometry},
                                                summary_.candidates, reason);
            if (!coding) {
                reason = bake + reason;
                return std::nullopt;
            }
            model = encoder_.refine(*coding, targets, summary_.error);
            if (model) break;
        }
        if (!model) {
            reason = fmt::format(
                "{}{:.3g} % of the transfer and an RMS distance of {:.3g} were not met by any step "
                "that was tried",
                bake, 100.0 * targets.transfer, targets.geometry);
            return std::nullopt;
        }
        // Floats may have needed a component more than was asked about.
        if (const uint64_t cost = multiply_adds(*model);
            target_.decode_cost && cost > *target_.decode_cost) {
            reason = fmt::format(
                "{}a transfer error of {:.3g} % takes {} multiply-adds a vertex, "
                "--max-decode-cost allows {}",
                bake, 100.0 * targets.transfer, cost, *target_.decode_cost);
            return std::nullopt;
        }
        summary_.transfer_target = targets.transfer;
        summary_.geometry_target = targets.geometry;
        nlohmann::ordered_json provenance = nlohmann::ordered_json::parse(
            bake_provenance(material_.bake.identity(), material_.statistics));
        provenance["noise"] = noise_ == NoiseTreatment::shrink ? "shrink" : "keep";
        provenance["measured"] =
            nlohmann::ordered_json::parse(error_statement_json(summary_.error, target_.spectrum));
        model->provenance_json = provenance.dump();
        PackedFile file(*model);
        return Result{std::move(*model), std::move(file)};
    }

    // The smallest error whose file fits. Errors: threshold exceeded, with the smallest file there is.
    // say  is told each error that is tried
    Result fit(uint64_t most_bytes, const std::function<void(const char*)>& say) {
        // Sizes fall about as a power of the error. Bisection in its logarithm; the last that fits.
        double low = std::log(1.02 * std::max(1e-4, material_.floor.transfer.total()));
        double high = std::log(0.5);
        check_reachable(material_, std::exp(high));
        constexpr int kRounds = 7;
        std::string reason;
        std::optional<Result> best;
        TargetSummary of_best;
        uint64_t smallest = 0;
        for (int round = 0; round < kRounds; ++round) {
            // First whether anything fits at all.
            const double at = round == 0 ? high : 0.5 * (low + high);
            say(fmt::format("trying a transfer error of {:.3g} %", 100.0 * std::exp(at)).c_str());
            auto result = meet(std::exp(at), reason);
            if (result) smallest = result->file.size_bytes();
            if (result && result->file.size_bytes() <= most_bytes) {
                best = std::move(result);
                of_best = summary_;
                high = at;
            } else if (round == 0) {
                throw_missed(
                    result
                        ? fmt::format("{}: --max-size asks for {} bytes; with a transfer error of "
                                      "50 % it takes {}",
                                      material_.bake.directory().string(), most_bytes, smallest)
                        : reason);
            } else {
                low = at;
            }
        }
        summary_ = of_best;
        return std::move(*best);
    }

  private:
    const Material& material_;
    NoiseTreatment noise_;
    const EncodeTarget& target_;
    TargetSummary& summary_;
    Encoder encoder_;
};

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
    PAIM_CHECK(target.transfer_error || target.size_bytes);
    remove_abandoned_files(std::filesystem::absolute(output).parent_path(),
                           output.filename().string() + ".");
    say("finding components");
    const Material material = read_material(bake, options, target);
    TargetSummary summary;
    summary.floor = material.floor.transfer.total();
    summary.num_vertices = material.geometry.num_points;
    summary.num_poses = bake.num_poses();
    if (target.transfer_error) check_reachable(material, *target.transfer_error);

    say("comparing ways to code them");
    TargetEncoder encoder(material, options, target, summary);
    std::string reason;
    std::optional<Result> result;
    if (target.transfer_error) {
        result = encoder.meet(*target.transfer_error, reason);
        if (!result) throw_missed(reason);
        if (target.size_bytes && result->file.size_bytes() > *target.size_bytes) {
            throw_missed(
                fmt::format("{}: a transfer error of {:.3g} % takes {} bytes, --max-size allows {}",
                            bake.directory().string(), 100.0 * *target.transfer_error,
                            result->file.size_bytes(), *target.size_bytes));
        }
    } else {
        result = encoder.fit(*target.size_bytes, say);
    }
    result->file.write(output);
    summary.size_bytes = result->file.size_bytes();
    summary.geometry_components = result->model.geometry.num_components;
    for (Candidate& candidate : summary.candidates) {
        if (!candidate.chosen) continue;
        // Refining may have changed what was compared.
        const Model& model = result->model;
        candidate.bands = model.layout.bands;
        candidate.components = model.transfer.num_components;
        candidate.multiply_adds = static_cast<uint32_t>(multiply_adds(model));
    }
    return summary;
}

}  // namespace paim
