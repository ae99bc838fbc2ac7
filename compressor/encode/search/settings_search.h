// Which coding of both parts should meet a target, by estimates.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compressor/encode/search/position_search.h"
#include "compressor/encode/search/search_memo.h"
#include "compressor/encode/search/transfer_search.h"

namespace paim {

// A way to code both parts, with the steps that it can be made finer or coarser with.
struct Coding {
    PositionCoding positions;
    TransferCoding transfer;
};

class CodingSearch {
  public:
    CodingSearch(const EncodeProblem& problem, const EncodeOptions& options,
                 const EncodeTarget& target, SearchMemo& memo)
        : problem_(problem),
          options_(options),
          target_(target),
          positions_(memo.positions),
          search_(problem, options, target, memo.codecs ? &*memo.codecs : nullptr) {}

    // The best coding that should meet the targets. Nothing, with the reason, if none does. Leaves
    // what was compared in `candidates`. Codings of earlier calls are gone by now
    // (TransferSearch::codings).
    std::optional<Coding> choose(const Targets& targets, std::vector<Candidate>& candidates,
                                 std::string& reason);

  private:
    double transfer_budget(double target) const;
    std::string missed_positions(const SurfaceTarget& target) const;
    std::string missed_transfer(double target);
    uint64_t estimated_overhead_bytes() const;

    const EncodeProblem& problem_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    PositionFinder& positions_;
    TransferSearch search_;
};

}  // namespace paim
