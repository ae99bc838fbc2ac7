// Time goes by.
#include "player/view/animation.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

// fmod() that is never negative.
double wrap(double value, double period) {
    const double rest = std::fmod(value, period);
    return rest < 0.0 ? rest + period : rest;
}

}  // namespace

void advance(Animation& animation, uint32_t num_poses, double poses_per_second, double elapsed_s) {
    if (!animation.playing) return;
    const double step = elapsed_s * poses_per_second * animation.speed;
    if (!animation.ping_pong) {
        animation.time = wrap(animation.time + step, static_cast<double>(num_poses));
        return;
    }
    const double last = static_cast<double>(num_poses) - 1.0;
    if (last == 0.0) {
        animation.time = 0.0;
        return;
    }
    // Along a path there and back, of which the second half is the way back.
    const double time = std::clamp(animation.time, 0.0, last);
    const double before = animation.turned_back ? 2.0 * last - time : time;
    const double along = wrap(before + step, 2.0 * last);
    animation.turned_back = along > last;
    animation.time = animation.turned_back ? 2.0 * last - along : along;
}

double shown_time(const Animation& animation, uint32_t num_poses) {
    const double last = static_cast<double>(num_poses) - 1.0;
    const double time = std::clamp(animation.time, 0.0, last);
    return animation.in_betweens ? time : std::floor(time);
}

void show_pose(Animation& animation, double pose) {
    animation.time = pose;
    animation.playing = false;
}

void step_pose(Animation& animation, uint32_t num_poses, int step) {
    const auto count = static_cast<double>(num_poses);
    const double pose = std::min(animation.time, count - 1.0);
    const double next = step < 0 ? std::ceil(pose) - 1.0 : std::floor(pose) + 1.0;
    show_pose(animation, next < 0.0 ? count - 1.0 : next >= count ? 0.0 : next);
}

}  // namespace paim::player
