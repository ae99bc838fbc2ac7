// Files that meet a target, ready to be written.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compressor/encode/search/rate_control.h"
#include "paim/format/paim/packed_file.h"

namespace paim {

struct EncodedFile {
    PackedFile file;
    AssetError error;  // measured
    Targets targets;   // that were met
    std::vector<Candidate> candidates;
    uint32_t geometry_components = 0;
    Coding coding;  // with the steps that it was made with
};

class EncodedFiles {
  public:
    // Keeps references.
    EncodedFiles(const EncodeProblem& problem, const EncodeOptions& options,
                 const EncodeTarget& target, SearchMemo& memo)
        : problem_(problem),
          options_(options),
          target_(target),
          positions_(memo.positions),
          search_(problem, options, target, memo) {}

    Targets targets(double transfer_error) const {
        return targets_of(target_, transfer_error, problem_.best_achievable.geometry.diagonal);
    }

    // Of a file of this error: all but geometry and transfer of the part that moves.
    uint64_t overhead_bytes(double transfer_error);

    // A coding that should do for an error, and how large that makes geometry and transfer, about.
    struct Draft {
        Coding coding;
        std::vector<Candidate> candidates;
        uint64_t estimated_bytes = 0;  // without the overhead
    };
    std::optional<Draft> draft(double transfer_error, std::string& reason);

    // The file of this error. Nothing, with the reason, if there is none.
    // draft  of this error or one near by, with steps that should meet it
    std::optional<EncodedFile> meet(double transfer_error, std::string& reason);
    std::optional<EncodedFile> meet(double transfer_error, Draft draft, std::string& reason);

  private:
    // A file of these targets, whose worst vertex may err by any amount.
    std::optional<RefinedAsset> meet_all_but_vertices(const Targets& targets,
                                                      std::vector<Candidate>& candidates,
                                                      std::string& reason);
    // What is chosen again for as long as the target leaves room and files become smaller.
    // aim  that the refined one was chosen for
    RefinedAsset use_all_of(const Targets& targets, Targets aim, RefinedAsset refined,
                            std::vector<Candidate>& candidates);
    // Nothing if no steps meet the targets.
    std::optional<RefinedAsset> refine_steps(const Targets& targets, Coding coding);
    std::optional<EncodedFile> pack(const Targets& targets, std::vector<Candidate> candidates,
                                    RefinedAsset refined, std::string& reason) const;
    const QuantisedStill& still_of(const Targets& targets);
    std::string bake_name() const { return problem_.bake.directory().string(); }

    const EncodeProblem& problem_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    PositionFinder& positions_;
    CodingSearch search_;
    QuantisedStill still_;  // of the last targets that were asked about
    std::optional<Targets> still_targets_;
};

}  // namespace paim
