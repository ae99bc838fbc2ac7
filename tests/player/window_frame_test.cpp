// The window itself: its size, its panels, and OpenGL.
#include <epoxy/gl.h>
#include <imgui_internal.h>

#include <algorithm>
#include <string>

#include "tests/player/window_fixture.h"

namespace paim::player {
namespace {

class WindowFrameTest : public WindowTest {};

TEST_F(WindowFrameTest, PictureHasTheNewSize) {
    show(make_test_asset({}));
    for (const auto& [width, height] : {std::pair{300, 200}, {500, 240}, {200, 333}}) {
        user().resize(width, height);
        settle();
        const ScreenPicture picture = screen();
        EXPECT_EQ(picture.width, width);
        EXPECT_EQ(picture.height, height);
        const Image expected = presenter().render(view(), width, height, 1);
        EXPECT_LE(
            largest_difference(picture, {width, height, tone_map(expected, view().tone_curve)}),
            kRounding);
        EXPECT_NE(picture.at(width / 2, height / 2), kBackdrop);
    }
}

TEST_F(WindowFrameTest, MinimisedWindowIsNotDrawn) {
    play(make_test_asset({}));
    step(3);
    user().minimise(true);
    step(3);  // what was on its way
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(app().step());
    const double time = view().animation.time;
    user().minimise(false);
    EXPECT_TRUE(step_until([&] { return app().step(); }));
    EXPECT_NE(view().animation.time, time);
    user().press("l");
    user().press("space");
    user().press("Tab");
    settle();
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
}

TEST_F(WindowFrameTest, EscapeEndsTheProgram) {
    play(make_test_asset({}));
    step(2);
    EXPECT_FALSE(app().window().should_close());
    user().press("Escape");
    app().step();
    ASSERT_TRUE(app().window().should_close());
    app().run();  // returns at once
    EXPECT_NE(screen().at(395, 5), (DisplayValue{0, 0, 0}));
}

TEST_F(WindowFrameTest, TabHidesThePanels) {
    show(make_test_asset({}));
    const ScreenPicture bare = screen();
    EXPECT_LE(largest_difference(bare, picture_of(view())), kRounding);
    press("Tab");
    const ScreenPicture with_panels = screen();
    EXPECT_NE(with_panels.at(20, 20), kBackdrop);
    EXPECT_NE(with_panels.at(200, 280), bare.at(200, 280));
    press("Tab");
    EXPECT_EQ(screen(), bare);
    // Keys work as before after a panel was used.
    press("Tab");
    const auto slider = find_widget("settings", "bands");
    ASSERT_TRUE(slider);
    click(slider->right - 3, slider->y);
    press("Tab");
    press("Tab");
    press("Tab");
    EXPECT_EQ(screen(), bare);
    press("Right");
    EXPECT_EQ(view().animation.time, 1.0);
}

TEST_F(WindowFrameTest, HelpNamesEveryKey) {
    show(make_test_asset({}), {"--size", "1280x720"});
    const ScreenPicture bare = screen();
    press("h");
    EXPECT_GT(largest_difference(screen(), bare), 100);
    EXPECT_EQ(ImGui::FindWindowByName("help")->ScrollMax.y, 0.0f);  // none is cut off
    const std::string help = words();
    for (const KeyGroup& group : key_groups()) {
        EXPECT_NE(help.find(group.title), std::string::npos) << group.title;
        for (const KeyRow& row : group.rows) {
            EXPECT_NE(help.find(row.keys), std::string::npos) << row.keys;
            EXPECT_NE(help.find(row.meaning), std::string::npos) << row.meaning;
        }
    }
    press("h");
    EXPECT_EQ(screen(), bare);
}

TEST_F(WindowFrameTest, FullScreenAndBack) {
    show(make_test_asset({}));
    const ScreenPicture before = screen();
    press("F11");
    EXPECT_TRUE(app().window().is_full_screen());
    EXPECT_EQ(screen().width, 1280);
    EXPECT_EQ(screen().height, 1024);
    EXPECT_LE(largest_difference(screen(), picture_of(view())), kRounding);
    press("F11");
    EXPECT_FALSE(app().window().is_full_screen());
    EXPECT_LE(largest_difference(screen(), before), kRounding);
}

// Everything that is ever drawn; the fixture fails on what OpenGL says of it.
TEST_F(WindowFrameTest, OpenGlComplainsOfNothing) {
    show(make_test_asset({}), {"--size", "640x620"});
    press("Tab");
    for (const char* section : {"Light", "Picture", "Camera and files"}) {
        const auto header = find_widget("settings", section);
        ASSERT_TRUE(header) << section;
        for (int i = 0; i < 2; ++i) {  // opens and closes it
            click(header->left + 40, header->y);
            settle();
        }
    }
    for (const char* key : {"n", "w", "y", "h", "o", "h", "o", "y", "y", "y", "x"}) press(key);
    for (size_t i = 0; i < surface_views().size(); ++i) press("v");
    press("x");
    press("c");
    click(500, 280);
    settle();
    EXPECT_EQ(complaints(), std::vector<std::string>());
    // A mistake would be seen.
    glEnable(GL_TEXTURE_2D_ARRAY);
    ASSERT_EQ(complaints().size(), 1u);
    EXPECT_EQ(glGetError(), GLenum{GL_INVALID_ENUM});
    complaints().clear();
}

}  // namespace
}  // namespace paim::player
