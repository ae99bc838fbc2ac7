// Bounds, pose by pose.
#include "player/view/pose_bounds_cache.h"

#include <algorithm>
#include <cmath>

#include "paim/codec/sequence_bounds.h"

namespace paim::player {

Bounds PoseBoundsCache::at(double time, uint32_t num_geometry_components) {
    if (num_geometry_components != num_components_ || bounds_.empty()) {
        num_components_ = num_geometry_components;
        bounds_.assign(asset_.num_poses(), std::nullopt);
    }
    const double clamped = std::clamp(time, 0.0, static_cast<double>(bounds_.size()) - 1.0);
    Bounds bounds = of_pose(static_cast<size_t>(std::floor(clamped)));
    const Bounds& next = of_pose(static_cast<size_t>(std::ceil(clamped)));
    bounds.lower = bounds.lower.cwiseMin(next.lower);
    bounds.upper = bounds.upper.cwiseMax(next.upper);
    return bounds;
}

const Bounds& PoseBoundsCache::of_pose(size_t p) {
    if (!bounds_[p]) bounds_[p] = pose_bounds(asset_, static_cast<double>(p), num_components_);
    return *bounds_[p];
}

}  // namespace paim::player
