// The components of the positions that can matter for a target.
#include "compressor/encode/search/held_positions.h"

#include <algorithm>
#include <cmath>

#include "compressor/encode/quantise/exceptions.h"
#include "compressor/encode/quantise/float_matrix.h"
#include "compressor/encode/svd/motion_groups.h"
#include "compressor/encode/svd/vertex_motion.h"
#include "paim/mesh/face_vertices.h"

namespace paim {

namespace {

// Edges and normals usually ask for distances between a quarter and all of the one that is asked
// for. Where they ask for less, components are read again.
constexpr double kHeldDistance = 0.25;

// What dropped components may take of the errors of edges and normals: a tenth in squares.
constexpr double kDroppedOfShape = 0.3;

// Share of a vertex's motion that dropped components may take, where it is more than the distance
// that is asked for. What is left is √(1 − 0.19) = 90 % of the motion.
const double kLostByTarget = std::sqrt(0.19);

}  // namespace

HeldPositions::HeldPositions(const BakeReader& bake, const PositionOutliers& outliers,
                             const GeometryRows& rows, const PrincipalComponents& all)
    : bake_(bake),
      rows_(rows),
      all_(all),
      counted_(face_vertices(bake.topology())),
      diagonals_(pose_diagonals(bake, outliers, counted_)),
      num_positions_(static_cast<double>(counted_.size()) * bake.num_poses()) {}

void HeldPositions::aim_at(const EncodeTarget& target) {
    const SurfaceTarget surface =
        targets_of(target, asked_error(target), diagonals_.largest).surface;
    const bool is_known = target.transfer_error.has_value();
    if (target_ == surface && is_known_ == is_known) return;
    target_ = surface;
    is_known_ = is_known;
    least_components_ = components_for_motion(
        rows_, all_, counted_,
        {kLostByTarget, std::max(target_->distance, kInvisibleMotion * diagonals_.median),
         motion_groups(bake_.topology(), rows_)});
    allow(kHeldDistance * target_->distance);
}

void HeldPositions::read(EncodeProblem& problem, const std::vector<uint32_t>& old_vertex,
                         uint32_t in_flight) const {
    if (!problem.geometry.mean.empty() && problem.geometry.num_components() == num_components_) {
        return;
    }
    problem.geometry = {};  // first, so that there is memory
    problem.geometry = read_factors(rows_, all_, num_components_, nullptr, old_vertex, in_flight);
    LowRank positions = float_matrix(problem.geometry, num_components_, Precision::f32);
    append_exceptions(problem.file_outliers, positions);
    static_cast<SurfaceError&>(problem.best_achievable) = problem.meter->surface(positions);
}

bool HeldPositions::need_more(const EncodeProblem& problem) {
    // For a size, the distance is that of very good files already.
    if (!is_known_ || num_components_ >= all_.rank()) return false;
    const double left = excess(problem.best_achievable, *target_);
    if (!(left > kDroppedOfShape)) return false;
    constexpr double kAim = 0.8, kSmallest = 1e-3;
    const uint32_t before = num_components_;
    allow(std::max(kSmallest, kAim * kDroppedOfShape / left) * distance_);
    num_components_ = std::max(num_components_, before + 1);
    return true;
}

void HeldPositions::allow(double distance) {
    distance_ = distance;
    num_components_ = components_for(
        all_.rank(), kDroppedShare * kDroppedShare * distance * distance * num_positions_,
        [&](uint32_t k) { return all_.singular_values[k] * all_.singular_values[k]; });
    num_components_ = std::max(num_components_, least_components_);
}

}  // namespace paim
