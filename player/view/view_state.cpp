// Views over time.
#include "player/view/view_state.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

void follow_limit(uint32_t& limit, uint32_t before, uint32_t now, uint32_t wanted) {
    limit = limit < before ? std::min(limit, now) : std::clamp(wanted, std::min(limit, now), now);
}

}  // namespace

void follow(ViewState& view, const ViewRange& before, const ViewRange& now,
            const DecodeLimits& wanted) {
    for (const auto member :
         {&DecodeLimits::geometry_components, &DecodeLimits::transfer_components,
          &DecodeLimits::vertex_components, &DecodeLimits::bands}) {
        follow_limit(view.limits.*member, before.limits.*member, now.limits.*member,
                     wanted.*member);
    }
    view.animation.time = std::min(view.animation.time, static_cast<double>(now.num_poses));
    view.coefficient = std::min(view.coefficient, now.limits.bands * now.limits.bands - 1);
}

void advance(ViewState& view, uint32_t num_poses, double poses_per_second, double elapsed_s) {
    advance(view.animation, num_poses, poses_per_second, elapsed_s);
    double& azimuth_rad = view.camera.orbit.azimuth_rad;
    azimuth_rad = std::remainder(azimuth_rad + elapsed_s * view.camera.turn_speed_deg * kPi / 180.0,
                                 2.0 * kPi);
    if (!view.light.turning) return;
    double& yaw_deg = view.light.orientation.yaw_deg;
    yaw_deg = std::remainder(yaw_deg + elapsed_s * view.light.turn_speed_deg, 360.0);
}

}  // namespace paim::player
