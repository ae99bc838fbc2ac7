// How large the values of a low-rank matrix can be in any pose.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/low_rank.h"

namespace paim {

// An upper bound of |mean + Σ_k w_k · component_k| over all points, all poses and the moments
// between them, and every number of components; +inf or no number where floats overflow. No partial
// sum of a decoder is larger than this by more than rounding.
// returns [planes]
std::vector<double> magnitude_bounds(const LowRank& matrix);

// The same bounds of floats whose rows come in pieces, so that they are never in memory as a whole.
// Half floats are rounded as in files.
class StreamedMagnitudes {
  public:
    // matrix  with weights; without the values of mean and components
    explicit StreamedMagnitudes(const LowRank& matrix);

    // The next rows of the mean, and the same rows of all components.
    // components  [K] of as many rows each, not rounded yet
    void add(std::span<const float> mean, std::span<const std::span<const float>> components);

    // [planes] Of the rows so far.
    const std::vector<double>& bounds() const { return bounds_; }

  private:
    uint32_t num_points_;
    bool halves_;
    std::vector<double> weights_;  // [K] the largest
    std::vector<double> maxima_;   // [1 + K] of mean and components in the plane at work
    std::vector<double> bounds_;
    uint64_t num_rows_ = 0;  // so far
};

}  // namespace paim
