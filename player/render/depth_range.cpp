// The depths of the corners of the bounds.
#include "player/render/depth_range.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

DepthRange depth_range(const Camera& camera, const Bounds& bounds) {
    const Vec3f forward = -camera.axes().col(2);
    const Vec3f half_size = 0.5f * (bounds.upper - bounds.lower);
    const float center = forward.dot(bounds.center() - camera.eye);
    const float extent = forward.cwiseAbs().dot(half_size);
    // A margin for what the float positions on the GPU round differently.
    const float far_distance = 1.01f * (center + extent);
    if (bounds.empty() || !std::isfinite(far_distance) || far_distance <= 1e-30f) {
        return {0.1f, 1.0f};  // nothing to see
    }
    return {std::max(0.99f * (center - extent), far_distance / 4096.0f), far_distance};
}

}  // namespace paim::player
