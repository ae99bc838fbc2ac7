// Reads a bake for one target after another.
#pragma once

#include <cstdint>
#include <memory>

#include "compressor/encode/decomposition.h"
#include "compressor/encode/memory/target_memory.h"
#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/search/held_positions.h"
#include "compressor/encode/search/problem.h"

namespace paim {

// What does not depend on the target is computed once: components of positions and transfer, their
// noise, and the mesh. A target decides how many components are held and measured. They are read
// again where that is another number than before. So a problem is the same, to the bit, whatever
// was read before it.
class ProblemReader {
  public:
    // Keeps references to bake and options.
    // Errors: unsupported, if options.memory_bytes do not suffice.
    ProblemReader(const BakeReader& bake, const EncodeOptions& options, const BandPower& spectrum,
                  std::shared_ptr<SearchProgress> progress);
    ProblemReader(const ProblemReader&) = delete;
    ProblemReader& operator=(const ProblemReader&) = delete;

    // The problem of this target, until the next one is read.
    // target  with the reader's spectrum
    // Errors: as read_problem()
    const EncodeProblem& read(const EncodeTarget& target);

    // What was read last.
    const EncodeProblem& problem() const { return problem_; }
    // All components of the bake in its bands.
    const Decomposition& decomposition() const { return parts_; }
    EncodeProblem take() && { return std::move(problem_); }

  private:
    void read_positions(const EncodeTarget& target, TargetSize& size);
    void read_transfer(const TargetSize& size);
    uint32_t transfer_components(const EncodeTarget& target) const;

    const BakeReader& bake_;
    const EncodeOptions& options_;
    const PositionOutliers outliers_;
    const EncodeSize streamed_;
    const uint32_t in_flight_;  // while components are found
    CacheOrder order_;
    EncodeProblem problem_;
    const GeometryRows geometry_rows_;
    const TransferRows transfer_rows_;
    const Decomposition parts_;
    const Shrinkage shrinkage_;
    HeldPositions positions_;
};

}  // namespace paim
