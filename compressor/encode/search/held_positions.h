// The components of the positions that can matter for a target, which the search holds in memory.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compressor/encode/data/bake_rows.h"
#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/search/problem.h"
#include "compressor/encode/search/targets.h"
#include "compressor/encode/svd/principal_components.h"

namespace paim {

// Components that are dropped beforehand may take this share of the error that is asked for.
constexpr double kDroppedShare = 0.15;

// The error of the transfer that components are kept for. A size is met with some error that is not
// known yet: then that of very good files.
inline double asked_error(const EncodeTarget& target) {
    return target.transfer_error.value_or(0.001);
}

class HeldPositions {
  public:
    // Keeps references.
    // rows, all  of the whole bake, without outliers, and their components
    HeldPositions(const BakeReader& bake, const PositionOutliers& outliers,
                  const GeometryRows& rows, const PrincipalComponents& all);

    // The target that the components are for, before anything is read. Another target than before
    // decides again how many components there are.
    void aim_at(const EncodeTarget& target);

    uint32_t num_components() const { return num_components_; }
    // Without which a vertex would lose its motion.
    uint32_t least_components() const { return least_components_; }

    // Reads the components into the problem, unless it holds as many, and measures what they leave
    // as floats (EncodeProblem::best_achievable).
    void read(EncodeProblem& problem, const std::vector<uint32_t>& old_vertex,
              uint32_t in_flight) const;

    // Whether the shape of the surface needs more components than were read, which num_components()
    // then says.
    bool need_more(const EncodeProblem& problem);

  private:
    // Components whose rest is kDroppedShare of this RMS distance.
    void allow(double distance);

    const BakeReader& bake_;
    const GeometryRows& rows_;
    const PrincipalComponents& all_;
    const std::vector<uint32_t> counted_;  // vertices of faces
    const PoseDiagonals diagonals_;
    double num_positions_ = 0.0;  // over vertices of faces and poses
    std::optional<SurfaceTarget> target_;
    bool is_known_ = false;  // the target
    double distance_ = 0.0;
    uint32_t num_components_ = 0, least_components_ = 0;
};

}  // namespace paim
