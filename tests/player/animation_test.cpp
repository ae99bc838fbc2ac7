// Time in an animation: loops, ping-pong, steps, and how long a clip of it is.
#include "player/view/animation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "player/clip.h"
#include "player/view/view_state.h"

namespace paim::player {
namespace {

constexpr uint32_t kNumPoses = 6;
constexpr double kRate = 24.0;  // poses a second

// `count` steps of a whole number of poses each.
std::vector<double> times(Animation animation, double poses, int count) {
    std::vector<double> shown;
    for (int i = 0; i < count; ++i) {
        advance(animation, kNumPoses, kRate, poses / kRate);
        shown.push_back(animation.time);
    }
    return shown;
}

// A quarter of a pose is a power of two; divided and multiplied by the rate, it keeps 15 digits.
void expect_near(const std::vector<double>& got, const std::vector<double>& expected) {
    ASSERT_EQ(got.size(), expected.size());
    for (size_t i = 0; i < got.size(); ++i) EXPECT_NEAR(got[i], expected[i], 1e-12) << i;
}

TEST(PlayedAnimation, StartsOverAfterTheLastPose) {
    Animation animation;
    animation.time = 4.25;
    expect_near(times(animation, 0.5, 4), {4.75, 5.25, 5.75, 0.25});
    animation.speed = 2.0;
    expect_near(times(animation, 0.5, 4), {5.25, 0.25, 1.25, 2.25});
    animation.time = 1.25;
    animation.speed = -1.0;
    expect_near(times(animation, 0.5, 4), {0.75, 0.25, 5.75, 5.25});
    animation.speed = -4.0;
    expect_near(times(animation, 0.5, 3), {5.25, 3.25, 1.25});
}

TEST(PlayedAnimation, TurnsRoundAtBothEnds) {
    Animation animation;
    animation.ping_pong = true;
    animation.time = 4.25;
    expect_near(times(animation, 0.5, 4), {4.75, 4.75, 4.25, 3.75});
    animation.time = 0.75;
    animation.turned_back = true;
    expect_near(times(animation, 0.5, 4), {0.25, 0.25, 0.75, 1.25});
    // Backwards in time is the other way along the same path.
    animation.speed = -1.0;
    expect_near(times(animation, 0.5, 3), {1.25, 1.75, 2.25});
    animation.turned_back = false;
    expect_near(times(animation, 0.5, 3), {0.25, 0.25, 0.75});
    animation.time = 5.0;
    animation.speed = 1.0;
    expect_near(times(animation, 1.0, 6), {4.0, 3.0, 2.0, 1.0, 0.0, 1.0});
}

// Once there and back, and once round, end where they began, however large or small the steps are.
TEST(PlayedAnimation, ComesBackToWhereItWas) {
    for (const bool ping_pong : {false, true}) {
        const double period = ping_pong ? 2.0 * (kNumPoses - 1) : kNumPoses;
        for (const double speed : {1.0, -1.0, 0.25, -4.0}) {
            for (const double steps : {1.0, 7.0, 640.0}) {
                Animation animation;
                animation.time = 2.5;
                animation.ping_pong = ping_pong;
                animation.speed = speed;
                for (int i = 0; i < static_cast<int>(steps); ++i) {
                    advance(animation, kNumPoses, kRate, period / std::abs(speed) / kRate / steps);
                }
                EXPECT_NEAR(animation.time, 2.5, 1e-10) << ping_pong << speed << steps;
                EXPECT_FALSE(animation.turned_back);
                // A laptop that slept for a week.
                advance(animation, kNumPoses, kRate, 604800.0 + 0.25 / kRate / speed);
                EXPECT_GE(animation.time, 0.0);
                EXPECT_LE(animation.time, kNumPoses);
            }
        }
    }
    Animation animation;
    animation.time = 2.5;
    expect_near(times(animation, 6e6 + 1.0, 2), {3.5, 4.5});
    expect_near(times(animation, -6e6 - 1.0, 2), {1.5, 0.5});
}

TEST(PlayedAnimation, OfOnePoseShowsIt) {
    for (const bool ping_pong : {false, true}) {
        for (const double speed : {1.0, -3.0}) {
            Animation animation;
            animation.ping_pong = ping_pong;
            animation.speed = speed;
            for (int i = 0; i < 100; ++i) {
                advance(animation, 1, kRate, 0.013);
                ASSERT_EQ(shown_time(animation, 1), 0.0);
            }
            step_pose(animation, 1, 1);
            EXPECT_EQ(animation.time, 0.0);
            step_pose(animation, 1, -1);
            EXPECT_EQ(animation.time, 0.0);
        }
    }
}

TEST(PlayedAnimation, StandsStillWhileItDoesNotPlay) {
    Animation animation;
    animation.time = 2.5;
    animation.playing = false;
    expect_near(times(animation, 1.0, 2), {2.5, 2.5});
    animation.playing = true;
    animation.speed = 0.0;
    expect_near(times(animation, 1.0, 2), {2.5, 2.5});
}

// The last pose is shown as long as the others: nothing lies between it and the first.
TEST(PlayedAnimation, HoldsTheLastPose) {
    Animation animation;
    animation.time = 5.75;
    EXPECT_EQ(shown_time(animation, kNumPoses), 5.0);
    animation.time = 4.75;
    EXPECT_EQ(shown_time(animation, kNumPoses), 4.75);
    animation.in_betweens = false;
    EXPECT_EQ(shown_time(animation, kNumPoses), 4.0);
    animation.time = 5.75;
    EXPECT_EQ(shown_time(animation, kNumPoses), 5.0);
    animation.time = -1.0;
    EXPECT_EQ(shown_time(animation, kNumPoses), 0.0);
}

TEST(PlayedAnimation, StepsToWholePosesAndStops) {
    const auto step = [](double time, int by) {
        Animation animation;
        animation.time = time;
        step_pose(animation, kNumPoses, by);
        EXPECT_FALSE(animation.playing);
        return animation.time;
    };
    EXPECT_EQ(step(2.0, 1), 3.0);
    EXPECT_EQ(step(2.5, 1), 3.0);
    EXPECT_EQ(step(2.5, -1), 2.0);
    EXPECT_EQ(step(2.0, -1), 1.0);
    EXPECT_EQ(step(5.0, 1), 0.0);
    EXPECT_EQ(step(5.75, 1), 0.0);
    EXPECT_EQ(step(5.75, -1), 4.0);
    EXPECT_EQ(step(0.0, -1), 5.0);
}

TEST(PlayedView, TurnsLightAndCamera) {
    ViewState view;
    view.light.turn_speed_deg = 90.0;
    view.camera.turn_speed_deg = -90.0;
    view.camera.orbit.azimuth_rad = 0.0;
    advance(view, kNumPoses, kRate, 0.5);
    EXPECT_NEAR(view.light.orientation.yaw_deg, 45.0, 1e-12);
    EXPECT_NEAR(view.camera.orbit.azimuth_rad, -kPi / 4.0, 1e-12);
    EXPECT_NEAR(view.animation.time, 0.0, 1e-12);  // twice round
    advance(view, kNumPoses, kRate, 3.5);
    EXPECT_NEAR(view.light.orientation.yaw_deg, 0.0, 1e-9);
    EXPECT_NEAR(view.camera.orbit.azimuth_rad, 0.0, 1e-9);
    view.light.turning = false;
    advance(view, kNumPoses, kRate, 0.5);
    EXPECT_NEAR(view.light.orientation.yaw_deg, 0.0, 1e-9);
}

TEST(ClipLength, IsOnceThroughWhatMoves) {
    ViewState view;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 48, 24.0), 2.0);
    view.animation.speed = -4.0;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 48, 24.0), 0.5);
    view.animation.ping_pong = true;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 49, 24.0), 1.0);
    // What stands still: once round, of light or camera, whichever turns faster.
    view.animation.speed = 0.0;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 49, 24.0), 30.0);
    view.animation.speed = 1.0;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 1, 24.0), 30.0);
    view.camera.turn_speed_deg = -36.0;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 1, 24.0), 10.0);
    view.camera.turn_speed_deg = 0.0;
    view.light.turning = false;
    EXPECT_DOUBLE_EQ(clip_seconds(view, 1, 24.0), 1.0);
}

TEST(ClipLength, IsAtLeastOnePictureAndBounded) {
    EXPECT_EQ(clip_length(24.0, 2.0).num_frames, 48u);
    EXPECT_EQ(clip_length(24.0, 2.0).frames_per_second, 24.0);
    EXPECT_EQ(clip_length(30.0, 0.25).num_frames, 8u);  // 7.5
    EXPECT_EQ(clip_length(0.01, 0.001).num_frames, 1u);
    EXPECT_EQ(clip_length(1000.0, 1e5).num_frames, kMaxClipFrames);
    EXPECT_EQ(clip_length(1000.0, 1e300).num_frames, kMaxClipFrames);
}

}  // namespace
}  // namespace paim::player
