// Files that meet a target, ready to be written.
#include "compressor/encode/search/encoded_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compressor/encode/data/provenance.h"
#include "compressor/encode/search/quantise_still.h"
#include "compressor/encode/search/target_words.h"
#include "paim/base/json_text.h"
#include "paim/codec/codecs.h"
#include "paim/codec/frame_cost.h"

namespace paim {

namespace {

// The error of the transfer that should bring the worst vertex down to its target: squared errors
// of both grow about alike above what the best of the bake leaves.
double transfer_for_vertex(const TransferError& best, double transfer, double worst,
                           double target) {
    // A little less than the target, and each time much, as the whole search is done again.
    constexpr double kAim = 0.97, kLeast = 0.25, kMost = 0.9;
    const double least = best.worst_vertex_error_to_bake;
    const double room = std::max(0.0, std::pow(kAim * target, 2.0) - least * least);
    const double share = std::clamp(room / (worst * worst - least * least), kLeast, kMost);
    const double floor = best.total();
    return std::sqrt(floor * floor + share * (transfer * transfer - floor * floor));
}

}  // namespace

const QuantisedStill& EncodedFiles::still_of(const Targets& targets) {
    if (still_targets_ == targets) return still_;
    still_ =
        is_integer(options_.precision) ? quantise_still(problem_, targets) : exact_still(problem_);
    still_targets_ = targets;
    return still_;
}

uint64_t EncodedFiles::overhead_bytes(double transfer_error) {
    Asset shell = problem_.shell;
    if (const QuantisedStill& still = still_of(targets(transfer_error)); still.mesh) {
        *shell.still() = *still.mesh;
    }
    CodedMesh& mesh = shell.moving();
    const auto nothing = [&](uint32_t num_planes) {
        LowRank matrix;
        matrix.num_points = mesh.topology.num_vertices;
        matrix.num_planes = num_planes;
        matrix.num_poses = problem_.bake.num_poses();
        matrix.mean = std::vector<int8_t>(matrix.num_rows());
        matrix.steps.assign(num_planes, 1.0f);
        return matrix;
    };
    mesh.positions = nothing(3);
    mesh.transfer = plain_transfer(nothing(mesh.layout.num_planes()));
    problem_.add_textures(shell);
    shell.provenance_json = bake_provenance(problem_.bake.identity(), problem_.statistics);
    return PackedFile(shell, Effort::fast).size_bytes();
}

std::optional<EncodedFiles::Draft> EncodedFiles::draft(double transfer_error, std::string& reason) {
    Draft draft;
    auto coding = search_.choose(targets(transfer_error), draft.candidates, reason);
    if (!coding) {
        reason = bake_name() + ": " + reason;
        return std::nullopt;
    }
    draft.coding = std::move(*coding);
    draft.estimated_bytes = draft.coding.positions.bytes + draft.coding.transfer.candidate.bytes;
    return draft;
}

std::optional<RefinedAsset> EncodedFiles::refine_steps(const Targets& targets, Coding coding) {
    problem_.progress->begin(fmt::format("measuring a file of {:.3g} %", 100.0 * targets.transfer),
                             0.98);
    const RefinedPositions* const positions = positions_.refine(coding.positions, targets.surface);
    if (positions == nullptr) return std::nullopt;
    return refine(problem_, still_of(targets), *positions, std::move(coding), targets);
}

std::optional<RefinedAsset> EncodedFiles::meet_all_but_vertices(const Targets& targets,
                                                                std::vector<Candidate>& candidates,
                                                                std::string& reason) {
    // What is chosen by estimates may leave its integers too little room once it is measured: then
    // something of a smaller error by estimate.
    for (const double margin : {1.0, 0.97, 0.93, 0.88}) {
        Targets smaller = targets;
        smaller.transfer *= margin;
        auto coding = search_.choose(smaller, candidates, reason);
        if (!coding) {
            reason = bake_name() + ": " + reason;
            return std::nullopt;
        }
        auto refined = refine_steps(targets, std::move(*coding));
        if (refined) return use_all_of(targets, smaller, std::move(*refined), candidates);
    }
    reason = fmt::format(
        "{}: {:.3g} % of the transfer was not met by any step that was tried: ask for a little "
        "more, or use --precision f32",
        bake_name(), 100.0 * targets.transfer);
    return std::nullopt;
}

// Estimates take the noise of the bake's best components for granted. A decoder that follows less of it
// has an error to spare, which is given to the estimates as well.
RefinedAsset EncodedFiles::use_all_of(const Targets& targets, Targets aim, RefinedAsset refined,
                                      std::vector<Candidate>& candidates) {
    constexpr double kUsed = 0.97;
    constexpr int kMaxRounds = 6;
    for (int round = 0; round < kMaxRounds; ++round) {
        const double error = refined.error.transfer.total();
        if (error >= kUsed * targets.transfer) break;
        aim.transfer = std::sqrt(aim.transfer * aim.transfer + targets.transfer * targets.transfer -
                                 error * error);
        std::string unused;
        std::vector<Candidate> others;
        auto coding = search_.choose(aim, others, unused);
        if (!coding) break;
        auto smaller = refine_steps(targets, std::move(*coding));
        const auto bytes = [](const RefinedAsset& of) {
            return of.coding.transfer.candidate.bytes;
        };
        if (!smaller || bytes(*smaller) >= bytes(refined)) break;
        refined = std::move(*smaller);
        candidates = std::move(others);
    }
    return refined;
}

std::optional<EncodedFile> EncodedFiles::meet(double transfer_error, std::string& reason) {
    const Targets targets = this->targets(transfer_error);
    Targets aim = targets;
    std::vector<Candidate> candidates;
    constexpr int kMaxRounds = 10;
    for (int round = 0; round < kMaxRounds; ++round) {
        auto refined = meet_all_but_vertices(aim, candidates, reason);
        if (!refined) return std::nullopt;
        const double worst = refined->error.transfer.worst_vertex_error_to_bake;
        if (worst <= targets.worst_vertex) {
            return pack(targets, std::move(candidates), std::move(*refined), reason);
        }
        aim.transfer = transfer_for_vertex(problem_.best_achievable.transfer, aim.transfer, worst,
                                           targets.worst_vertex);
    }
    reason = fmt::format(
        "{}: a worst vertex of {:.3g} % is asked for, and was not met by any {} down to "
        "{:.3g} %: allow a larger --max-vertex-error",
        bake_name(), 100.0 * targets.worst_vertex, target_words(problem_.layout).error,
        100.0 * aim.transfer);
    return std::nullopt;
}

std::optional<EncodedFile> EncodedFiles::meet(double transfer_error, Draft draft,
                                              std::string& reason) {
    const Targets targets = this->targets(transfer_error);
    auto refined = refine_steps(targets, std::move(draft.coding));
    if (!refined || refined->error.transfer.worst_vertex_error_to_bake > targets.worst_vertex) {
        return meet(transfer_error, reason);
    }
    return pack(targets, std::move(draft.candidates), std::move(*refined), reason);
}

std::optional<EncodedFile> EncodedFiles::pack(const Targets& targets,
                                              std::vector<Candidate> candidates,
                                              RefinedAsset refined, std::string& reason) const {
    Asset& asset = refined.asset;
    const CodedMesh& mesh = asset.moving();
    const auto cost =
        static_cast<uint32_t>(mesh.transfer->cost(mesh.layout, {}, true).per_vertex());
    // Floats may have needed a component more than was asked about.
    if (target_.decode_cost && cost > *target_.decode_cost) {
        reason = fmt::format(
            "{}: a {} of {:.3g} % takes {} multiply-adds a vertex, --max-decode-cost "
            "allows {}",
            bake_name(), target_words(problem_.layout).error, 100.0 * targets.transfer, cost,
            *target_.decode_cost);
        return std::nullopt;
    }
    for (Candidate& candidate : candidates) {
        if (!candidate.chosen) continue;
        // Refining may have changed what was compared.
        candidate.bands = mesh.layout.in_bands;
        candidate.components = mesh.transfer->matrix.num_components;
        candidate.multiply_adds = cost;
    }
    nlohmann::ordered_json provenance = nlohmann::ordered_json::parse(
        bake_provenance(problem_.bake.identity(), problem_.statistics));
    provenance["noise"] = options_.noise == NoiseTreatment::shrink ? "shrink" : "keep";
    provenance["targets"] = {{"transfer_total_error", targets.transfer},
                             {"position_rms", targets.surface.distance},
                             {"sted_worst_piece", targets.surface.sted},
                             {"normal_angle_deg_worst_piece", targets.surface.normal_angle_deg}};
    if (std::isfinite(targets.worst_vertex)) {
        provenance["targets"]["transfer_worst_vertex_deviation"] = targets.worst_vertex;
    }
    provenance["measured"] =
        nlohmann::ordered_json::parse(error_statement_json(refined.error, target_.spectrum));
    asset.provenance_json = json_text(provenance);
    problem_.add_textures(asset);
    return EncodedFile{PackedFile(asset),
                       refined.error,
                       targets,
                       std::move(candidates),
                       mesh.positions.num_usual_components(),
                       std::move(refined.coding)};
}

}  // namespace paim
