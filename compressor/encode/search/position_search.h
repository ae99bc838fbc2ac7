// Positions that meet a surface target: how many components, and with which step.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "compressor/encode/quantise/quantise.h"
#include "compressor/encode/search/problem.h"
#include "compressor/encode/search/targets.h"

namespace paim {

// A way to code positions.
struct PositionCoding {
    Quantiser quantiser;
    Precision precision = Precision::i16;
    uint64_t bytes = 0;  // by an estimate

    bool operator==(const PositionCoding&) const = default;
};

// As the coding says, integers smoothed. Error (unsupported) if integers of this step do not fit in
// 16 bits.
LowRank code_positions(const EncodeProblem& problem, const PositionCoding& coding);

// The cheapest integers that about meet the target, measured; floats where no integers of 16 bits
// do, or if `precision` is one of floats. Nothing if floats do not meet it either.
std::optional<PositionCoding> choose_positions(const EncodeProblem& problem, Precision precision,
                                               const SurfaceTarget& target);

struct RefinedPositions {
    LowRank matrix;
    SurfaceError error;  // measured
    PositionCoding coding;
};

// Makes the step finer until the target is met, and coarser where there is room. Positions become
// floats if no step was found. Nothing if floats do not meet the target either.
std::optional<RefinedPositions> refine_positions(const EncodeProblem& problem,
                                                 PositionCoding coding,
                                                 const SurfaceTarget& target);

// Both of one problem. What was asked for last is not computed again: searches for the transfer
// ask for the same positions several times.
class PositionFinder {
  public:
    // Keeps a reference to the problem.
    PositionFinder(const EncodeProblem& problem, Precision precision)
        : problem_(problem), precision_(precision) {}

    // Null: nothing meets the target. Results stay until the next call with something else.
    const PositionCoding* choose(const SurfaceTarget& target);
    const RefinedPositions* refine(const PositionCoding& coding, const SurfaceTarget& target);

    // The problem holds other components of the positions.
    void forget() {
        chosen_for_.reset();
        refined_for_.reset();
    }

  private:
    const EncodeProblem& problem_;
    const Precision precision_;
    std::optional<SurfaceTarget> chosen_for_;
    std::optional<PositionCoding> chosen_;
    std::optional<std::pair<PositionCoding, SurfaceTarget>> refined_for_;
    std::optional<RefinedPositions> refined_;
};

}  // namespace paim
