// The error of one vertex over the whole sequence, a few poses at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/decode_limits.h"
#include "player/inspect/limit_errors.h"

namespace paim::player {

// Errors are relative to all vertices of their pose, so that whole poses are decoded. Start again
// where limits or light change.
class VertexHistory {
  public:
    // Longer sequences are sampled at so many poses, evenly spaced from the first to the last.
    static constexpr uint32_t kMostPoses = 512;

    // errors  must outlive this object; it may measure other poses in between
    // part, vertex  of the asset (checked)
    VertexHistory(LimitErrors& errors, ErrorOf what, uint32_t part, uint32_t vertex,
                  const DecodeLimits& limits);

    // Measures at most so many further poses. Returns whether all are done.
    bool advance(size_t max_poses);
    // The same for as long as the time lasts, but at least one pose.
    bool advance(std::chrono::milliseconds duration);

    bool done() const { return values_.size() == times_.size(); }
    // All times, in poses, ascending; and the errors at the first of them.
    std::span<const double> times() const { return times_; }
    std::span<const float> values() const { return values_; }

  private:
    LimitErrors& errors_;
    ErrorOf what_;
    uint32_t part_, vertex_;
    DecodeLimits limits_;
    std::vector<double> times_;
    std::vector<float> values_;
};

}  // namespace paim::player
