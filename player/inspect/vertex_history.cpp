// Measures one vertex, pose by pose.
#include "player/inspect/vertex_history.h"

#include "paim/base/check.h"
#include "player/inspect/sample_times.h"

namespace paim::player {

VertexHistory::VertexHistory(LimitErrors& errors, ErrorOf what, uint32_t part, uint32_t vertex,
                             const DecodeLimits& limits)
    : errors_(errors),
      what_(what),
      part_(part),
      vertex_(vertex),
      limits_(limits),
      times_(sample_times(errors.asset().num_poses(), kMostPoses)) {
    PAIM_CHECK_LT(size_t{part}, errors.asset().parts.size());
    PAIM_CHECK_LT(vertex, errors.asset().parts[part].topology.num_vertices);
}

bool VertexHistory::advance(size_t max_poses) {
    for (size_t n = 0; n < max_poses && !done(); ++n) {
        const auto& errors = errors_.measure(what_, times_[values_.size()], limits_);
        values_.push_back(errors[part_][vertex_]);
    }
    return done();
}

bool VertexHistory::advance(std::chrono::milliseconds duration) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + duration;
    do {
        advance(size_t{1});
    } while (!done() && Clock::now() < end);
    return done();
}

}  // namespace paim::player
