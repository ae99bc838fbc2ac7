// Time goes by.
#include "player/ui/view_state.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

constexpr double kTurnDegreesPerSecond = 30.0;

void follow_limit(uint32_t& limit, uint32_t before, uint32_t now, uint32_t wanted) {
    limit = limit < before ? std::min(limit, now) : std::clamp(wanted, std::min(limit, now), now);
}

}  // namespace

void follow(ViewState& view, const ViewRange& before, const ViewRange& now,
            const DecodeLimits& wanted) {
    DecodeLimits& limits = view.limits;
    follow_limit(limits.geometry_components, before.geometry_components, now.geometry_components,
                 wanted.geometry_components);
    follow_limit(limits.transfer_components, before.transfer_components, now.transfer_components,
                 wanted.transfer_components);
    follow_limit(limits.vertex_components, before.vertex_components, now.vertex_components,
                 wanted.vertex_components);
    follow_limit(limits.bands, before.bands, now.bands, wanted.bands);
    view.time = std::min(view.time, static_cast<double>(now.num_poses));
}

void advance(ViewState& view, const ViewRange& range, float frames_per_second, double elapsed_s) {
    if (view.playing) {
        view.time = std::fmod(view.time + elapsed_s * static_cast<double>(frames_per_second),
                              static_cast<double>(range.num_poses));
    }
    if (view.turning) {
        view.env_rotation_deg =
            std::remainder(view.env_rotation_deg + elapsed_s * kTurnDegreesPerSecond, 360.0);
    }
}

}  // namespace paim::player
