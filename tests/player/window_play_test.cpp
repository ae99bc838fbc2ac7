// The window plays, stops and goes to moments of the animation.
#include <algorithm>
#include <cmath>

#include "player/view/framing.h"
#include "tests/player/window_fixture.h"

namespace paim::player {
namespace {

struct CodecCase {
    const char* name;
    uint32_t num_clusters, cluster_components;
};

class WindowPlayTest : public WindowTest, public testing::WithParamInterface<CodecCase> {
  protected:
    static Asset make_asset() {
        TestAssetOptions options;
        options.num_clusters = GetParam().num_clusters;
        options.cluster_components = GetParam().cluster_components;
        return make_test_asset(options);
    }
};

INSTANTIATE_TEST_SUITE_P(Codecs, WindowPlayTest,
                         testing::Values(CodecCase{"Svd", 0, 0}, CodecCase{"Cpca", 3, 2}),
                         [](const auto& codec) { return codec.param.name; });

TEST_P(WindowPlayTest, OpensPlayingUnderATurningLight) {
    play(make_asset());
    EXPECT_EQ(user().title(), "model.paim - paim-play");
    EXPECT_TRUE(app().panels().show_panels);
    user().press("Tab");
    step(3);
    const ScreenPicture first = screen();
    const double time = view().animation.time;
    EXPECT_TRUE(step_until([&] { return view().animation.time != time; }));
    const ScreenPicture second = screen();
    EXPECT_NE(first, second);

    // The pose rests, the light does not.
    user().press("Home");
    step(2);
    const ScreenPicture third = screen();
    const double yaw_deg = view().light.orientation.yaw_deg;
    EXPECT_TRUE(step_until([&] { return view().light.orientation.yaw_deg > yaw_deg + 10.0; }));
    EXPECT_GT(largest_difference(third, screen()), 1);
    EXPECT_EQ(view().animation.time, 0.0);
}

// All poses together reach to the edges of the middle 80 % of the shorter side, to a pixel of
// rasterisation on either side.
TEST_P(WindowPlayTest, BodyFillsFourFifthsOfTheShorterSide) {
    show(make_asset());
    int top = 300, bottom = -1, left = 400, right = -1;
    for (uint32_t p = 0; p < app().session().range().num_poses; ++p) {
        const ScreenPicture picture = screen();
        for (int y = 0; y < picture.height; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (picture.at(x, y) == kBackdrop) continue;
                top = std::min(top, y);
                bottom = std::max(bottom, y + 1);
                left = std::min(left, x);
                right = std::max(right, x + 1);
            }
        }
        press("Right");
    }
    EXPECT_NEAR(bottom - top, 0.8 * 300, 2.0);
    EXPECT_NEAR(bottom + top, 300, 2.0);
    EXPECT_LE(right - left, 0.8 * 400 + 2);
    EXPECT_NEAR(right + left, 400, 2.0);
}

TEST_P(WindowPlayTest, RedrawsNothingWhileNothingMoves) {
    play(make_asset());
    user().press("l");
    user().press("space");
    settle();
    EXPECT_FALSE(view().animation.playing);
    const ScreenPicture before = screen();
    const ViewState rested = view();
    for (int i = 0; i < 5; ++i) EXPECT_FALSE(app().step());
    EXPECT_EQ(screen(), before);
    EXPECT_EQ(view(), rested);
    user().press("space");
    EXPECT_TRUE(step_until([&] { return view() != rested && view().animation.playing; }));
    EXPECT_TRUE(app().step());
}

TEST_P(WindowPlayTest, KeysGoFromPoseToPose) {
    show(make_asset());
    ScreenPicture last = screen();
    const auto expect_pose = [&](const char* key, double pose) {
        press(key);
        EXPECT_EQ(view().animation.time, pose) << key;
        ViewState expected = view();
        expected.animation.time = pose;
        const ScreenPicture now = screen();
        EXPECT_LE(largest_difference(now, picture_of(expected)), kRounding) << key;
        EXPECT_GT(largest_difference(now, last), 10) << key;
        last = now;
    };
    expect_pose("Right", 1.0);
    expect_pose("Right", 2.0);
    expect_pose("Left", 1.0);
    expect_pose("End", 5.0);
    expect_pose("Home", 0.0);
    expect_pose("Left", 5.0);
}

TEST_P(WindowPlayTest, TimelineIsScrubbedByTheMouse) {
    show(make_asset());
    const CameraView camera = view().camera;
    press("Tab");
    const auto bar = find_widget("poses", "##pose");
    ASSERT_TRUE(bar);
    move((bar->left + bar->right) / 2, bar->y);
    user().button(1, true);
    step(2);
    EXPECT_NEAR(view().animation.time, 2.5, 0.4);
    double last = 5.1;
    for (const double share : {0.9, 0.7, 0.4, 0.2}) {
        move(bar->left + static_cast<int>(share * (bar->right - bar->left)), bar->y);
        EXPECT_LT(view().animation.time, last - 0.4);
        last = view().animation.time;
    }
    user().button(1, false);
    settle();
    EXPECT_FALSE(view().animation.playing);
    EXPECT_GT(last, 0.2);
    EXPECT_EQ(view().camera, camera);
    press("Tab");
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
    EXPECT_EQ(view().animation.time, last);
}

TEST_P(WindowPlayTest, KeysChangeSpeedDirectionAndEnds) {
    show(make_asset());
    press("Up");
    EXPECT_EQ(view().animation.speed, 2.0);
    press("Down");
    press("Down");
    EXPECT_EQ(view().animation.speed, 0.5);
    press("r");
    EXPECT_EQ(view().animation.speed, -0.5);
    // Backwards round the start, to the picture of that moment.
    user().press("space");
    EXPECT_TRUE(step_until([&] { return view().animation.time > 3.0; }));
    user().press("space");
    settle();
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
    press("p");
    press("r");
    user().press("space");
    EXPECT_TRUE(step_until([&] { return view().animation.turned_back; }));
    user().press("space");
    settle();
    EXPECT_LT(view().animation.time, 5.0);
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
    press("i");
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
    ViewState whole_pose = view();
    whole_pose.animation.time = std::floor(view().animation.time);
    EXPECT_LE(largest_difference(screen(), picture_of(whole_pose)), kRounding);
}

}  // namespace
}  // namespace paim::player
