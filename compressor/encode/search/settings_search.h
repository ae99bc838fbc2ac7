// Which coding of both parts should meet a target, by estimates.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compressor/encode/search/transfer_search.h"

namespace paim {

// What both parts shall meet. Transfer errors are relative, distances in scene units.
struct Targets {
    double transfer = 0.0;
    double geometry = 0.0;

    bool operator==(const Targets&) const = default;
};

// What goes with this error of the transfer.
Targets targets_of(const EncodeProblem& problem, const EncodeTarget& target, double transfer_error);

// A way to code both parts, with the steps that it can be made finer or coarser with.
struct Coding {
    Quantiser geometry;
    Precision geometry_precision = Precision::i16;
    uint64_t geometry_bytes = 0;
    TransferCoding transfer;
};

// Positions as floats, with the fewest components that leave at most this RMS distance. False if not
// even all components as floats do.
bool use_float_positions(const EncodeProblem& problem, double distance, Coding& coding);

class CodingSearch {
  public:
    CodingSearch(const EncodeProblem& problem, const EncodeOptions& options,
                 const EncodeTarget& target)
        : problem_(problem),
          options_(options),
          target_(target),
          search_(problem, options, target) {}

    // The best coding that should meet the targets. Nothing, with the reason, if none does. Leaves
    // what was compared in `candidates`. Codings of earlier calls are gone by now
    // (TransferSearch::codings).
    std::optional<Coding> choose(const Targets& targets, std::vector<Candidate>& candidates,
                                 std::string& reason);

  private:
    double transfer_budget(double target) const;
    bool choose_geometry(double target, Coding& coding) const;
    std::string missed_geometry(double target) const;
    std::string missed_transfer(double target);
    uint64_t estimated_overhead_bytes() const;

    const EncodeProblem& problem_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    TransferSearch search_;
};

}  // namespace paim
