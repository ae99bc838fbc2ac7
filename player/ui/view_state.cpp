// Time goes by.
#include "player/ui/view_state.h"

#include <cmath>

namespace paim::player {

namespace {

constexpr double kTurnDegreesPerSecond = 30.0;

}  // namespace

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
