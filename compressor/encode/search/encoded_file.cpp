// Files that meet a target, ready to be written.
#include "compressor/encode/search/encoded_file.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>

#include "compressor/encode/data/provenance.h"
#include "compressor/encode/search/quantise_scenery.h"
#include "compressor/encode/search/transfer_cost.h"

namespace paim {

const QuantisedScenery& TargetFiles::scenery_of(const Targets& targets) {
    if (scenery_targets_ == targets) return scenery_;
    scenery_ = is_integer(options_.precision)
                   ? quantise_scenery(problem_, targets.transfer, targets.geometry)
                   : exact_scenery(problem_);
    scenery_targets_ = targets;
    return scenery_;
}

uint64_t TargetFiles::frame_bytes(double transfer_error) {
    Model frame = problem_.frame;
    frame.scenery = scenery_of(targets(transfer_error)).scenery;
    const auto fill = [&](uint32_t num_planes, LowRankMatrix& matrix) {
        matrix.num_points = frame.topology.num_vertices;
        matrix.num_planes = num_planes;
        matrix.num_poses = problem_.bake.num_poses();
        matrix.mean = std::vector<int8_t>(matrix.num_rows());
        matrix.steps.assign(num_planes, 1.0f);
    };
    fill(3, frame.geometry);
    fill(frame.layout.num_planes(), frame.transfer);
    frame.provenance_json = bake_provenance(problem_.bake.identity(), problem_.statistics);
    return PackedFile(frame, Effort::fast).size_bytes();
}

std::optional<TargetFiles::Draft> TargetFiles::draft(double transfer_error, std::string& reason) {
    Draft draft;
    auto coding = search_.choose(targets(transfer_error), draft.candidates, reason);
    if (!coding) {
        reason = bake_name() + ": " + reason;
        return std::nullopt;
    }
    draft.coding = std::move(*coding);
    draft.estimated_bytes = draft.coding.geometry_bytes + draft.coding.transfer.candidate.bytes;
    return draft;
}

std::optional<TargetFile> TargetFiles::meet(double transfer_error, std::string& reason) {
    const Targets targets = this->targets(transfer_error);
    // What is chosen by estimates may leave its integers too little room once it is measured: then
    // something of a smaller error by estimate.
    for (const double margin : {1.0, 0.97, 0.93, 0.88}) {
        std::vector<Candidate> candidates;
        auto coding =
            search_.choose({margin * targets.transfer, targets.geometry}, candidates, reason);
        if (!coding) {
            reason = bake_name() + ": " + reason;
            return std::nullopt;
        }
        auto refined = refine(problem_, scenery_of(targets), std::move(*coding), targets);
        if (refined) return pack(targets, std::move(candidates), std::move(*refined), reason);
    }
    reason = fmt::format(
        "{}: {:.3g} % of the transfer and an RMS distance of {:.3g} were not met by any step that "
        "was tried",
        bake_name(), 100.0 * targets.transfer, targets.geometry);
    return std::nullopt;
}

std::optional<TargetFile> TargetFiles::meet(double transfer_error, Draft draft,
                                            std::string& reason) {
    const Targets targets = this->targets(transfer_error);
    auto refined = refine(problem_, scenery_of(targets), std::move(draft.coding), targets);
    if (!refined) return meet(transfer_error, reason);
    return pack(targets, std::move(draft.candidates), std::move(*refined), reason);
}

std::optional<TargetFile> TargetFiles::pack(const Targets& targets,
                                            std::vector<Candidate> candidates, RefinedModel refined,
                                            std::string& reason) const {
    Model& model = refined.model;
    const uint32_t cost = transfer_cost(model);
    // Floats may have needed a component more than was asked about.
    if (target_.decode_cost && cost > *target_.decode_cost) {
        reason = fmt::format(
            "{}: a transfer error of {:.3g} % takes {} multiply-adds a vertex, --max-decode-cost "
            "allows {}",
            bake_name(), 100.0 * targets.transfer, cost, *target_.decode_cost);
        return std::nullopt;
    }
    for (Candidate& candidate : candidates) {
        if (!candidate.chosen) continue;
        // Refining may have changed what was compared.
        candidate.bands = model.layout.bands;
        candidate.components = model.transfer.num_components;
        candidate.multiply_adds = cost;
    }
    nlohmann::ordered_json provenance = nlohmann::ordered_json::parse(
        bake_provenance(problem_.bake.identity(), problem_.statistics));
    provenance["noise"] = options_.noise == NoiseTreatment::shrink ? "shrink" : "keep";
    provenance["measured"] =
        nlohmann::ordered_json::parse(error_statement_json(refined.error, target_.spectrum));
    model.provenance_json = provenance.dump();
    return TargetFile{PackedFile(model),
                      refined.error,
                      targets,
                      std::move(candidates),
                      model.geometry.num_components,
                      std::move(refined.coding)};
}

}  // namespace paim
