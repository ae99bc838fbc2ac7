// Files that the window opens and writes.
#include <fmt/format.h>

#include <algorithm>

#include "paim/base/file.h"
#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "tests/player/window_fixture.h"
#include "tests/read_png.h"

namespace paim::player {
namespace {

class WindowFilesTest : public WindowTest {
  protected:
    // Messages are in the lower half.
    ScreenPicture upper_half(ScreenPicture picture) const {
        picture.height /= 2;
        picture.pixels.resize(static_cast<size_t>(picture.width) *
                              static_cast<size_t>(picture.height));
        return picture;
    }
    static ScreenPicture read_picture(const std::filesystem::path& path) {
        const PngPicture png = read_png(path);
        return {png.width, png.height, png.pixels};
    }
    static size_t num_files(const std::filesystem::path& folder) {
        const std::filesystem::directory_iterator files(folder);
        return static_cast<size_t>(std::distance(begin(files), end(files)));
    }
};

TEST_F(WindowFilesTest, DroppedLightChangesLightAndBackground) {
    show(make_test_asset({}));
    press("k");
    press("k");
    ASSERT_EQ(view().background.kind, Background::Kind::environment);
    const ScreenPicture before = screen();
    write_exr(directory_ / "red.exr", Image(8, 4, Vec3f(0.9f, 0.1f, 0.2f)));
    EXPECT_EQ(drop({directory_ / "red.exr"}).substr(0, 14), "light: red.exr");
    const ScreenPicture after = screen();
    const ToneCurve curve;
    for (const auto& [x, y] : {std::pair{3, 3}, {396, 3}, {396, 296}}) {
        EXPECT_NEAR(after.at(x, y)[0], curve.apply(0.9f), kRounding);
        EXPECT_NEAR(after.at(x, y)[1], curve.apply(0.1f), kRounding);
        EXPECT_NEAR(after.at(x, y)[2], curve.apply(0.2f), kRounding);
    }
    // The body, too.
    EXPECT_GT(std::abs(int{after.at(200, 100)[1]} - int{before.at(200, 100)[1]}), 10);
    EXPECT_LE(largest_difference(upper_half(after), upper_half(picture_of(view()))), kRounding);
    EXPECT_EQ(user().title(), "model.paim - paim-play");
}

TEST_F(WindowFilesTest, DroppedModelTakesThePlaceOfTheFirst) {
    show(make_test_asset({}));
    press("End");
    press("bracketleft");
    const ScreenPicture before = screen();
    TestAssetOptions options;
    options.num_poses = 4;
    options.transfer_components = 3;
    options.num_clusters = 2;
    options.cluster_components = 1;
    const Asset other = make_test_asset(options);
    write_paim(directory_ / "other.paim", other);
    EXPECT_EQ(drop({directory_ / "other.paim"}), "model: other.paim");
    EXPECT_EQ(user().title(), "other.paim - paim-play");
    EXPECT_EQ(app().session().range().num_poses, 4u);
    EXPECT_EQ(view().limits.transfer_components, 3u);
    EXPECT_EQ(view().animation.time, 0.0);
    const ScreenPicture after = screen();
    EXPECT_GT(largest_difference(upper_half(after), upper_half(before)), 10);
    // As a window that was opened on it.
    const ScreenPicture dropped = upper_half(after);
    show(other);
    EXPECT_LE(largest_difference(dropped, upper_half(screen())), kRounding);
}

TEST_F(WindowFilesTest, FilesThatCannotBeOpenedLeaveAllAsItIs) {
    show(make_test_asset({}));
    const ScreenPicture before = screen();
    std::vector<char> bytes = read_file(directory_ / "model.paim", 1 << 24);
    bytes[bytes.size() / 2] ^= 1;
    write_file(directory_ / "damaged.paim", std::string_view(bytes.data(), bytes.size()));
    write_file(directory_ / "cut.paim", std::string_view(bytes.data(), bytes.size() / 3));
    write_file(directory_ / "damaged.exr", "not a picture");
    std::filesystem::create_directory(directory_ / "folder.paim");
    std::filesystem::create_directory(directory_ / "folder.exr");
    for (const char* name : {"damaged.paim", "cut.paim", "damaged.exr", "folder.paim", "folder.exr",
                             "state", "missing.paim", "missing.exr", "missing"}) {
        const std::string message = drop({directory_ / name});
        EXPECT_NE(message.find(name), std::string::npos) << name << ": " << message;
        EXPECT_EQ(message.find("model: "), std::string::npos) << message;
        EXPECT_EQ(message.find("light: "), std::string::npos) << message;
        EXPECT_EQ(user().title(), "model.paim - paim-play");
        EXPECT_EQ(largest_difference(upper_half(screen()), upper_half(before)), 0) << name;
        EXPECT_NE(screen(), before) << name;  // the message is shown
    }
    EXPECT_FALSE(app().window().should_close());
    press("Right");
    EXPECT_GT(largest_difference(upper_half(screen()), upper_half(before)), 10);
}

TEST_F(WindowFilesTest, KeysSaveWhatTheWindowShows) {
    show(make_test_asset({}), {"--supersample", "1"});
    drag({200, 150}, {240, 150});
    press("Right");
    press("m");
    const ScreenPicture shown = screen();
    user().press("s");
    app().step();
    EXPECT_EQ(app().message(), "saved model-001.png");
    EXPECT_LE(largest_difference(read_picture("model-001.png"), shown), kRounding);
    press("s");
    EXPECT_LE(largest_difference(read_picture("model-002.png"), shown), kRounding);
    press("s", true);
    const Image image = read_exr("model-001.exr");
    EXPECT_LE(
        largest_difference(
            {image.width, image.height, tone_map(image, Presenter::tone_curve(view()))}, shown),
        kRounding);
}

TEST_F(WindowFilesTest, SavedViewShowsTheSamePicture) {
    const Asset asset = make_test_asset({});
    show(asset);
    drag({200, 150}, {240, 110});
    drag({200, 150}, {220, 150}, 3);
    user().turn_wheel(-2);
    for (const char* key :
         {"Right", "Right", "bracketleft", "bracketleft", "period", "e", "m", "x"}) {
        press(key);
    }
    const ScreenPicture shown = screen();
    press("d");
    play(asset, {"--view", "model-001-view.json", "--save-view", "last.json"});
    press("Tab");
    EXPECT_LE(largest_difference(screen(), shown), kRounding);
    app().window().close();
    app().run();
    EXPECT_EQ(read_file("last.json", 1 << 16), read_file("model-001-view.json", 1 << 16));
}

// Twice as many samples of a clip's picture as of the window's are another picture at edges alone.
TEST_F(WindowFilesTest, RecordsAClip) {
    show(make_test_asset({}), {"--supersample", "1"});
    user().press("F9");
    app().window().poll(0.0);
    EXPECT_EQ(app().message(), "recording 6 pictures into model-001-clip; F9 stops");
    EXPECT_TRUE(step_until([&] { return app().message().starts_with("saved"); }));
    EXPECT_EQ(app().message(), "saved 6 pictures in model-001-clip");
    settle();
    ASSERT_EQ(num_files("model-001-clip"), 6u);
    for (int p = 0; p < 6; ++p) {
        const auto name = fmt::format("model-001-clip/model_{:05}.png", p + 1);
        ViewState pose = view();
        pose.animation.time = p;
        EXPECT_LE(largest_difference(read_picture(name), picture_of(pose)), kRounding) << name;
    }
    // Four times as long at a quarter of the speed, and stopped after the third picture.
    for (int i = 0; i < 2; ++i) press("Down");
    user().press("F9");
    step(3);
    user().press("F9");
    app().step();
    EXPECT_EQ(app().message(), "stopped: 3 pictures in model-002-clip");
    settle();
    EXPECT_EQ(num_files("model-002-clip"), 3u);
    // A file that cannot be opened does not end it.
    user().press("F9");
    app().step();
    drop({directory_ / "missing.paim"});
    EXPECT_EQ(num_files("model-003-clip"), 24u);
}

}  // namespace
}  // namespace paim::player
