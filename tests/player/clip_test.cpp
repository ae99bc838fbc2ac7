// The view that a command line asks for, and clips that start with it.
#include "player/clip.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"
#include "paim/codec/sequence_bounds.h"
#include "paim/image/png.h"
#include "paim/light/sky.h"
#include "player/gl/headless_context.h"
#include "player/start_view.h"
#include "player/view/view_file.h"
#include "tests/player/test_asset.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

constexpr int kClipWidth = 24, kClipHeight = 16;
constexpr float kClipAspect = float{kClipWidth} / kClipHeight;

// A scene without files: a ball of 40 poses, on its way.
class ClipTest : public testing::Test {
  protected:
    ClipTest() : scene_{nullptr, EnvironmentLight(make_sky()), {}, {}, 0, {}} {
        TestAssetOptions options;
        options.num_poses = 40;
        options.bands = 3;
        Asset asset = make_test_asset(options);
        for (uint32_t p = 0; p < options.num_poses; ++p) {
            asset.moving().root_motion.push_back(
                {Eigen::Quaterniond::Identity(), Vec3d(0.05 * p, 0.0, 0.0)});
        }
        scene_.bounds = sequence_bounds(asset);
        scene_.asset = std::make_shared<const Asset>(std::move(asset));
        scene_.units = {0.5, Vec3d(1000.0, 2000.0, 3000.0)};
    }

    Options parse(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {"paim-play", "ball.paim"});
        std::vector<const char*> pointers;
        for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
        Options options;
        EXPECT_EQ(parse_options(static_cast<int>(pointers.size()), pointers.data(), options), -1);
        options.limits = {3, 5, 3, 0};  // what the ball has
        return options;
    }

    ViewState start(const std::vector<std::string>& arguments) {
        const Options options = parse(arguments);
        Presenter presenter = make_presenter(options, scene_);
        return start_view(options, scene_, presenter, kClipAspect);
    }

    // The pictures of a clip, as they are in their files.
    std::vector<std::vector<char>> clip(Presenter& presenter, const ViewState& start,
                                        const ClipLength& length) {
        const std::filesystem::path folder = directory_ / "of" / "clip";
        ClipWriter writer(folder, "ball", length, start, {kClipWidth, kClipHeight}, 1);
        std::vector<std::vector<char>> files;
        bool more = true;
        while (more) {
            more = writer.write_next(presenter);
            EXPECT_EQ(more, writer.num_written() < length.num_frames);
            files.push_back(
                read_file(folder / fmt::format("ball_{:05}.png", writer.num_written()), 1'000'000));
        }
        EXPECT_FALSE(writer.write_next(presenter));
        EXPECT_EQ(writer.num_written(), length.num_frames);
        return files;
    }

    std::vector<char> png_of(Presenter& presenter, const ViewState& view) {
        const Image image = presenter.render(view, kClipWidth, kClipHeight, 1);
        write_png(directory_ / "expected.png", image, Presenter::tone_curve(view));
        return read_file(directory_ / "expected.png", 1'000'000);
    }

    std::unique_ptr<gl::Context> context_ = gl::make_headless_context();
    Scene scene_;
    TemporaryDirectory directory_;
};

TEST_F(ClipTest, IsWhatTheWindowWouldShow) {
    const Options options = parse({"--pose", "3.5", "--turn-camera", "60", "--speed", "2",
                                   "--tone-map", "aces", "--camera-target", "pose"});
    Presenter presenter = make_presenter(options, scene_);
    ViewState view = start_view(options, scene_, presenter, kClipAspect);
    const auto files = clip(presenter, view, {12.0, 7});
    std::set<std::vector<char>> different(files.begin(), files.end());
    EXPECT_EQ(different.size(), files.size());
    // Other pictures in between do not change them.
    Presenter other = make_presenter(options, scene_);
    for (size_t i = 0; i < files.size(); ++i) {
        EXPECT_EQ(files[i], png_of(other, view)) << i;
        advance(view, 40, 24.0, 1.0 / 12.0);
    }
}

// A view that stands still in the window plays in a clip.
TEST_F(ClipTest, Plays) {
    const Options options = parse({});
    Presenter presenter = make_presenter(options, scene_);
    ViewState view = start_view(options, scene_, presenter, kClipAspect);
    view.animation.playing = false;
    view.light.turning = false;
    const auto files = clip(presenter, view, {24.0, 2});
    EXPECT_EQ(files[0], png_of(presenter, view));
    EXPECT_NE(files[0], files[1]);
}

// Colours mean the same in all pictures, also between the poses that the scale was measured at.
TEST_F(ClipTest, KeepsTheScaleOfColours) {
    for (const char* const surface : {"coefficient", "transfer-error", "radiance-error"}) {
        const Options options = parse({"--surface", surface, "--coefficient", "2"});
        Presenter presenter = make_presenter(options, scene_);
        ViewState view = start_view(options, scene_, presenter, kClipAspect);
        view.limits.transfer_components = 1;
        view.num_instances = 4;
        ClipWriter writer(directory_ / "scale", "ball", {30.0, 50}, view, {kClipWidth, kClipHeight},
                          1);
        std::set<float> scales;
        bool more = true;
        while (more) {
            more = writer.write_next(presenter);
            ASSERT_NE(presenter.painter().legend(), nullptr);
            scales.insert(presenter.painter().legend()->highest);
        }
        EXPECT_EQ(scales.size(), 1u) << surface;
        EXPECT_GT(*scales.begin(), 0.0f) << surface;
    }
}

// The scale of one picture is one, on both sides of a comparison: another picture of the same has it, too.
TEST_F(ClipTest, HasOneScaleInAComparison) {
    const Options options = parse({"--surface", "coefficient", "--compare", "wipe"});
    for (const uint32_t coefficient : {0u, 1u, 2u, 3u, 5u, 8u}) {
        Presenter presenter = make_presenter(options, scene_);
        ViewState view = start_view(options, scene_, presenter, kClipAspect);
        view.coefficient = coefficient;
        view.limits.transfer_components = 0;
        const Image first = presenter.render(view, kClipWidth, kClipHeight, 1);
        const float scale = presenter.painter().legend()->highest;
        const Image again = presenter.render(view, kClipWidth, kClipHeight, 1);
        EXPECT_EQ(presenter.painter().legend()->highest, scale) << coefficient;
        EXPECT_EQ(first.pixels, again.pixels) << coefficient;
    }
}

TEST_F(ClipTest, StartsWithAllThatMoves) {
    const ViewState view = start({});
    ViewState expected;
    expected.camera = view.camera;
    expected.limits = view.limits;
    EXPECT_EQ(view, expected);
    EXPECT_EQ(view.camera.target, CameraTarget::all);
    EXPECT_NEAR(view.camera.orbit.azimuth_rad, double{kDefaultAzimuth_rad}, 1e-6);
    // In the middle of the path, which is 1.95 long, as it looks from there.
    EXPECT_NEAR(view.camera.orbit.target.x(), 0.975, 0.3);
}

TEST_F(ClipTest, PutsTheCameraWhereOptionsSay) {
    const ViewState plain = start({});
    const ViewState turned = start({"--camera", "90,-10,2"});
    EXPECT_NEAR(turned.camera.orbit.azimuth_rad, kPi / 2.0, 1e-12);
    EXPECT_NEAR(turned.camera.orbit.elevation_rad, -kPi / 18.0, 1e-12);
    const ViewState nearer = start({"--camera", "90,-10"});
    EXPECT_NEAR(turned.camera.orbit.distance, 2.0 * nearer.camera.orbit.distance, 1e-9);
    const ViewState follows = start({"--camera-target", "pose"});
    EXPECT_EQ(follows.camera.target, CameraTarget::pose);
    EXPECT_LT(follows.camera.orbit.distance, plain.camera.orbit.distance);
    const ViewState point = start({"--camera-target", "1002,2001,3000"});
    EXPECT_EQ(point.camera.target, CameraTarget::point);
    EXPECT_EQ(point.camera.orbit.target, Vec3d(1.0, 0.5, 0.0));  // scale 0.5
}

TEST_F(ClipTest, StartsFromAViewFile) {
    ViewState saved = start({"--camera", "12,34,1.5", "--pose", "7", "--surface", "coefficient",
                             "--coefficient", "5", "--instances", "3"});
    saved.camera.orbit.target += Vec3d(0.25, 0.5, 0.0);
    saved.camera.target = CameraTarget::point;
    const std::string file = (directory_ / "view.json").string();
    write_view(file, saved, scene_.units);
    saved.camera.orbit.framed_distance = saved.camera.orbit.distance;
    EXPECT_EQ(start({"--view", file}), saved);
    // Options are over the file.
    ViewState expected = saved;
    expected.animation.time = 9.0;
    expected.coefficient = 3;
    EXPECT_EQ(start({"--view", file, "--pose", "9", "--coefficient", "3"}), expected);
    // The direction of the camera alone: it still looks at the point.
    const ViewState turned = start({"--view", file, "--camera", "50,10"});
    EXPECT_NEAR(turned.camera.orbit.azimuth_rad, 50.0 * kPi / 180.0, 1e-12);
    EXPECT_EQ(turned.camera.target, CameraTarget::point);
    EXPECT_EQ(turned.camera.orbit.target, saved.camera.orbit.target);
    // What it looks at alone.
    const ViewState follows = start({"--view", file, "--camera-target", "pose"});
    EXPECT_EQ(follows.camera.target, CameraTarget::pose);
    EXPECT_NEAR(follows.camera.orbit.azimuth_rad, saved.camera.orbit.azimuth_rad, 1e-12);
    EXPECT_LE(follows.camera.orbit.target.norm(), 0.2);  // near the middle of the body
}

// Each copy of a crowd moves on like the first: over again or there and back, without a jump in between.
TEST_F(ClipTest, CopiesPlayLikeTheFirst) {
    const Options options = parse({"--instances", "5"});
    Presenter presenter = make_presenter(options, scene_);
    for (const bool ping_pong : {false, true}) {
        ViewState view = start_view(options, scene_, presenter, kClipAspect);
        view.animation.ping_pong = ping_pong;
        std::vector<double> before;
        for (int step = 0; step < 400; ++step) {
            const Frame frame = presenter.frame(view);
            std::vector<double> times;
            for (const Instance& copy : frame.instances) {
                times.push_back(time_of(frame, copy, 40));
            }
            ASSERT_EQ(times.size(), 5u);
            for (size_t i = 0; i < before.size(); ++i) {
                const double moved = times[i] - before[i];
                const bool starts_over = before[i] > 38.999999 && times[i] < 0.250001;
                EXPECT_TRUE(std::abs(moved) < 0.250001 || (!ping_pong && starts_over))
                    << ping_pong << ' ' << i << ' ' << before[i] << ' ' << times[i];
            }
            before = times;
            advance(view, 40, 24.0, 0.25 / 24.0);
        }
    }
}

// A file may be of a model with more poses and detail.
TEST_F(ClipTest, LowersWhatTheModelDoesNotHave) {
    ViewState saved = start({});
    saved.animation.time = 1e6;
    saved.limits = {1000, 1000, 1000, 1000};
    saved.coefficient = 4000;
    const std::string file = (directory_ / "view.json").string();
    write_view(file, saved, scene_.units);
    const Options options = parse({"--view", file});
    Presenter presenter = make_presenter(options, scene_);
    const ViewState view = start_view(options, scene_, presenter, kClipAspect);
    EXPECT_EQ(view.animation.time, 39.0);
    EXPECT_EQ(view.limits, options.limits);
    EXPECT_EQ(view.coefficient, 8u);
}

// Whatever a view file may hold can be drawn.
TEST_F(ClipTest, DrawsViewsAtTheEndsOfTheirRanges) {
    const std::string file = (directory_ / "view.json").string();
    for (const char* const text :
         {R"({"camera": {"place": [1e5, -1e5, 1e5]}})", R"({"camera": {"distance": 1e30}})",
          R"({"camera": {"elevation_rad": 1.56}})",
          R"({"light": {"strength": 1e6}, "key_light": {"on": true, "strength": 1e6,
              "color": [1e6, 1e6, 1e6], "angular_diameter_deg": 0.5}})",
          R"({"display": {"gamma": 0.1, "exposure_ev": 30}})", R"({"instances": 10000})",
          R"({"detail": {"bands": 1, "geometry_components": 0, "transfer_components": 0}})",
          R"({"comparison": {"kind": "wipe", "split": 1}, "surface": {"edges": true}})",
          R"({"comparison": {"kind": "wipe", "split": 0}, "background": {"kind": "blurred"}})",
          R"({"surface": {"view": "coefficient", "coefficient": 4095, "channel": 3}})"}) {
        write_file(file, text);
        const Options options = parse({"--view", file});
        Presenter presenter = make_presenter(options, scene_);
        const ViewState view = start_view(options, scene_, presenter, kClipAspect);
        for (const int width : {1, kClipWidth}) {
            EXPECT_EQ(presenter.render(view, width, 3, 1).pixels.size(), 3u * width) << text;
            const gl::Target target(width, 3);
            presenter.draw(view, target);
        }
        presenter.pick(view, 0.5f, 0.5f, 1.0f);
    }
}

// Cameras are of floats: one that stands on what it looks at sees nothing.
TEST_F(ClipTest, RefusesCamerasThatFloatsDoNotHold) {
    const std::string file = (directory_ / "view.json").string();
    for (const char* const text :
         {R"({"camera": {"place": [1e38, -1e38, 1e38]}})", R"({"camera": {"distance": 1e-38}})",
          R"({"camera": {"place": [1e38, 1e38, 1e38], "target": "pose"}})"}) {
        write_file(file, text);
        const Options options = parse({"--view", file});
        Presenter presenter = make_presenter(options, scene_);
        try {
            start_view(options, scene_, presenter, kClipAspect);
            FAIL() << text;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
        }
    }
    const Options options = parse({"--camera-target", "1e30,1e30,1e30"});
    Presenter presenter = make_presenter(options, scene_);
    EXPECT_THROW(start_view(options, scene_, presenter, kClipAspect), Error);
}

}  // namespace
}  // namespace paim::player
