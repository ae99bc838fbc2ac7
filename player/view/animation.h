// The animation in time: where it is, how fast it plays, and what happens at its ends.
#pragma once

#include <cstdint>

namespace paim::player {

constexpr double kMaxSpeed = 4.0;

struct Animation {
    // In poses. While it loops, 0 … P: the last pose is held as long as the others.
    double time = 0.0;
    bool playing = true;
    double speed = 1.0;      // −4 … 4 times the rate of the file; below zero it plays backwards
    bool ping_pong = false;  // turns round at the first and last pose, instead of starting over
    bool in_betweens = true;   // shows moments between poses; otherwise the pose before
    bool turned_back = false;  // of ping-pong: on its way back

    bool operator==(const Animation&) const = default;
};

// Moves on by the time that has passed.
// num_poses  P, at least 1
void advance(Animation& animation, uint32_t num_poses, double poses_per_second, double elapsed_s);

// The moment that is shown, 0 … P−1 poses.
double shown_time(const Animation& animation, uint32_t num_poses);

// Goes to a pose and stops.
void show_pose(Animation& animation, double pose);

// Stops at the whole pose before (step −1) or after (step 1) the one shown, round the ends.
void step_pose(Animation& animation, uint32_t num_poses, int step);

}  // namespace paim::player
