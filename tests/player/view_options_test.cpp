// Every option that sets a view, and those of views, clips and decoders: what it sets, and what it refuses.
#include "player/view_options.h"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "paim/base/error.h"
#include "player/options.h"
#include "player/view/view_fields.h"

namespace paim::player {
namespace {

Options parse_play(std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"paim-play", "a.paim"});
    Options options;
    EXPECT_EQ(parse_options(static_cast<int>(arguments.size()), arguments.data(), options), -1);
    return options;
}

ViewState changed(const Options& options) {
    ViewState view;
    for (const auto& change : options.view_changes) change(view);
    return view;
}

// One option as it is typed, and what it makes of a view.
struct ViewOption {
    std::vector<const char*> arguments;
    std::function<void(ViewState&)> set;
};

std::vector<ViewOption> view_options() {
    using View = ViewState;
    constexpr auto kColor = Background::Kind::color;
    return {
        {{"--pose", "2.5"}, [](View& v) { v.animation.time = 2.5; }},
        {{"--pose", "0"}, [](View&) {}},
        {{"--speed", "-4"}, [](View& v) { v.animation.speed = -4.0; }},
        {{"--ping-pong"}, [](View& v) { v.animation.ping_pong = true; }},
        {{"--whole-poses"}, [](View& v) { v.animation.in_betweens = false; }},
        {{"--instances", "10000"}, [](View& v) { v.num_instances = 10000; }},
        {{"--env-rotation", "-36000"}, [](View& v) { v.light.orientation.yaw_deg = -36000.0; }},
        {{"--env-pitch", "12.5"}, [](View& v) { v.light.orientation.pitch_deg = 12.5; }},
        {{"--env-roll", "36000"}, [](View& v) { v.light.orientation.roll_deg = 36000.0; }},
        {{"--env-strength", "0.5"}, [](View& v) { v.light.strength = 0.5; }},
        {{"--turn-light", "-360"}, [](View& v) { v.light.turn_speed_deg = -360.0; }},
        {{"--turn-light", "0"},
         [](View& v) {
             v.light.turn_speed_deg = 0.0;
             v.light.turning = false;
         }},
        {{"--turn-camera", "360"}, [](View& v) { v.camera.turn_speed_deg = 360.0; }},
        {{"--key-light", "30,-40"},
         [](View& v) {
             v.light.key_on = true;
             v.light.key.azimuth_deg = 30.0;
             v.light.key.elevation_deg = -40.0;
         }},
        {{"--key-light", "-360,90,180,2.5"},
         [](View& v) {
             v.light.key_on = true;
             v.light.key.azimuth_deg = -360.0;
             v.light.key.elevation_deg = 90.0;
             v.light.key.angular_diameter_deg = 180.0;
             v.light.key.strength = 2.5;
         }},
        {{"--background", "env"}, [](View&) {}},
        {{"--background", "blurred"},
         [](View& v) { v.background.kind = Background::Kind::blurred; }},
        {{"--background", "black"}, [](View& v) { v.background.kind = kColor; }},
        {{"--background", "0,0.5,1"},
         [](View& v) {
             v.background = {kColor, {0.0f, 0.5f, 1.0f}};
         }},
        {{"--exposure", "-2.5"}, [](View& v) { v.tone_curve.exposure_ev = -2.5f; }},
        {{"--exposure", "auto"}, [](View&) {}},
        {{"--tone-map", "reinhard"},
         [](View& v) { v.tone_curve.tone_operator = ToneOperator::reinhard; }},
        {{"--gamma", "2.2"}, [](View& v) { v.tone_curve.gamma = 2.2f; }},
        {{"--gamma", "0"}, [](View&) {}},
        {{"--surface", "transfer-error"}, [](View& v) { v.surface = SurfaceView::transfer_error; }},
        {{"--coefficient", "4095"}, [](View& v) { v.coefficient = 4095; }},
        {{"--gloss", "vertex"}, [](View& v) { v.gloss = GlossDetail::vertex; }},
        {{"--no-textures"}, [](View& v) { v.textures = false; }},
        {{"--edges"}, [](View& v) { v.edges = true; }},
        {{"--compare", "wipe"}, [](View& v) { v.comparison = Comparison::wipe; }},
        {{"--split", "0.25"}, [](View& v) { v.split = 0.25; }},
    };
}

TEST(ViewOptions, SetWhatTheySay) {
    for (const ViewOption& option : view_options()) {
        ViewState expected;
        option.set(expected);
        EXPECT_EQ(changed(parse_play(option.arguments)), expected) << option.arguments[0];
    }
    EXPECT_EQ(changed(parse_play({})), ViewState());
}

// In any order and number: no option changes what another has set.
TEST(ViewOptions, AreAddedUp) {
    std::set<std::string> given;
    std::vector<const char*> arguments;
    ViewState expected;
    for (const ViewOption& option : view_options()) {
        if (!given.insert(option.arguments[0]).second) continue;
        option.set(expected);
        arguments.insert(arguments.end(), option.arguments.begin(), option.arguments.end());
    }
    EXPECT_EQ(changed(parse_play(arguments)), expected);
}

// What the tests of this file know is what the command line has.
TEST(ViewOptions, AreAllTested) {
    CLI::App app;
    const ViewOptions options(app);
    std::set<std::string> known, tested;
    for (const CLI::Option* const option : app.get_options()) known.insert(option->get_name());
    known.erase("--help");
    for (const ViewOption& option : view_options()) tested.insert(option.arguments[0]);
    EXPECT_EQ(tested, known);
}

// Words of every list are accepted, and set different values.
TEST(ViewOptions, KnowAllWords) {
    for (const auto& [word, value] : surface_view_names()) {
        EXPECT_EQ(changed(parse_play({"--surface", word.c_str()})).surface, value);
    }
    for (const auto& [word, value] : comparison_names()) {
        EXPECT_EQ(changed(parse_play({"--compare", word.c_str()})).comparison, value);
    }
    for (const auto& [word, value] : tone_operator_names()) {
        EXPECT_EQ(changed(parse_play({"--tone-map", word.c_str()})).tone_curve.tone_operator,
                  value);
    }
}

TEST(ViewOptions, SayWhetherTheExposureIsChosen) {
    EXPECT_TRUE(parse_play({"--exposure", "auto"}).auto_exposure);
    EXPECT_FALSE(parse_play({"--exposure", "1"}).auto_exposure);
    EXPECT_FALSE(parse_play({}).auto_exposure);
}

// Expects that the first argument is refused, by its name and what was given.
void expect_play_refuses(const std::vector<const char*>& arguments) {
    try {
        parse_play(arguments);
        ADD_FAILURE() << arguments[0] << ' ' << arguments[1];
    } catch (const Error& error) {
        const std::string message = error.what();
        EXPECT_EQ(error.code(), ExitCode::usage) << message;
        EXPECT_NE(message.find(arguments[0]), std::string::npos) << message;
    }
}

TEST(ViewOptions, RefuseWhatIsOutOfRange) {
    const std::vector<std::pair<const char*, std::vector<const char*>>> refused{
        {"--pose", {"-0.1", "1000000001", "nan", "inf"}},
        {"--speed", {"4.1", "-4.1", "nan"}},
        {"--instances", {"0", "10001", "2.5", "-1", "nan"}},
        {"--env-rotation", {"36000.5", "-36000.5", "nan", "inf"}},
        {"--env-pitch", {"36000.5", "-36000.5", "nan"}},
        {"--env-roll", {"36000.5", "-36000.5", "nan"}},
        {"--env-strength", {"-0.1", "1000001", "nan"}},
        {"--turn-light", {"360.5", "-360.5", "nan"}},
        {"--turn-camera", {"360.5", "-360.5", "nan"}},
        {"--key-light",
         {"30", "30,", ",30", "1,2,3,4,5", "361,0", "0,91", "0,0,0.4", "0,0,181", "0,0,10,-1",
          "nan,0", "0,nan", "0,0,nan", "0,0,10,inf", "a,b", "1,2 ", "1;2", ""}},
        {"--background", {"sky", "1,1", "0,0,1.5", "-1,0,0", "nan", "1,1,1,1", ""}},
        {"--exposure", {"30.5", "-31", "nan", "automatic", "1x", ""}},
        {"--tone-map", {"film", "", "ACES"}},
        {"--gamma", {"0.05", "11", "-1", "nan"}},
        {"--surface", {"nonsense", "", "Lit"}},
        {"--coefficient", {"-1", "4096", "1.5", "nan"}},
        {"--compare", {"left", "", "side"}},
        {"--split", {"-0.1", "1.1", "nan"}},
    };
    for (const auto& [option, values] : refused) {
        for (const char* const value : values) expect_play_refuses({option, value});
    }
}

TEST(CameraTargetOption, SetsTheTarget) {
    EXPECT_FALSE(parse_play({}).target);
    EXPECT_EQ(parse_play({"--camera-target", "all"}).target->target, CameraTarget::all);
    EXPECT_EQ(parse_play({"--camera-target", "pose"}).target->target, CameraTarget::pose);
    const Options options = parse_play({"--camera-target", "1.5,-2,1e6"});
    EXPECT_EQ(options.target->target, CameraTarget::point);
    EXPECT_EQ(options.target->point, Vec3d(1.5, -2.0, 1e6));
    for (const char* const text : {"", "none", "1,2", "1,2,3,4", "1,2,x", "1,2,nan", "1,2,inf",
                                   "1,2,1e31", "1,2,3 ", "All"}) {
        expect_play_refuses({"--camera-target", text});
    }
}

TEST(CameraOption, SetsAnglesAndDistance) {
    EXPECT_FALSE(parse_play({}).camera);
    const Options options = parse_play({"--camera", "270,-45,3"});
    EXPECT_NEAR(options.camera->azimuth_rad, -kPi / 2.0, 1e-15);
    EXPECT_NEAR(options.camera->elevation_rad, -kPi / 4.0, 1e-15);
    EXPECT_EQ(options.camera->distance_factor, 3.0);
    EXPECT_EQ(parse_play({"--camera", "0,0"}).camera->distance_factor, 1.0);
    for (const char* const text : {"", "1", "1,2,3,4", "361,0", "0,90", "0,-90", "0,0,0.01",
                                   "0,0,101", "nan,0", "0,nan", "0,0,nan"}) {
        expect_play_refuses({"--camera", text});
    }
}

TEST(ViewFileOptions, NameFiles) {
    const Options options = parse_play({"--view", "a.json", "--save-view", "b.json"});
    EXPECT_EQ(options.view_path, "a.json");
    EXPECT_EQ(options.save_view_path, "b.json");
    EXPECT_TRUE(options.opens_window());
    EXPECT_FALSE(parse_play({}).view_path || parse_play({}).save_view_path);
    expect_play_refuses({"--save-view", "b.json", "--bench", "3"});
}

TEST(ClipOptions, SayWhereHowFastAndHowLong) {
    EXPECT_FALSE(parse_play({}).clip);
    const Options plain = parse_play({"--frames-out", "clip"});
    ASSERT_TRUE(plain.clip);
    EXPECT_EQ(plain.clip->directory, "clip");
    EXPECT_FALSE(plain.clip->frames_per_second || plain.clip->seconds);
    EXPECT_FALSE(plain.opens_window());
    const Options full =
        parse_play({"--frames-out", "clip", "--fps", "30", "--seconds", "2.5", "--json"});
    EXPECT_EQ(full.clip->frames_per_second, 30.0);
    EXPECT_EQ(full.clip->seconds, 2.5);
    EXPECT_TRUE(full.json);
    expect_play_refuses({"--fps", "30"});
    expect_play_refuses({"--seconds", "2"});
    for (const char* const text : {"0", "0.001", "1001", "-1", "nan"}) {
        expect_play_refuses({"--fps", text, "--frames-out", "clip"});
    }
    for (const char* const text : {"0", "0.0001", "100001", "-1", "nan"}) {
        expect_play_refuses({"--seconds", text, "--frames-out", "clip"});
    }
    for (const std::vector<const char*>& mode : std::vector<std::vector<const char*>>{
             {"--snapshot", "a.png"}, {"--bench", "3"}, {"--frames", "3"}}) {
        std::vector<const char*> arguments{"--frames-out", "clip"};
        arguments.insert(arguments.end(), mode.begin(), mode.end());
        expect_play_refuses(arguments);
    }
}

TEST(DecoderOption, IsAutomaticGpuOrCpu) {
    EXPECT_EQ(parse_play({}).decoder, Decoder::automatic);
    EXPECT_EQ(parse_play({"--decoder", "auto"}).decoder, Decoder::automatic);
    EXPECT_EQ(parse_play({"--decoder", "gpu"}).decoder, Decoder::gpu);
    EXPECT_EQ(parse_play({"--decoder", "cpu"}).decoder, Decoder::cpu);
}

// Words and numbers that the parser itself refuses end in the exit code of a wrong command line.
TEST(ViewOptions, RefuseWhatCannotBeRead) {
    for (const std::vector<const char*>& arguments :
         std::vector<std::vector<const char*>>{{"--decoder", "tpu"},
                                               {"--pose", "first"},
                                               {"--pose"},
                                               {"--view"},
                                               {"--speed", "1x"},
                                               {"--fps", "many"},
                                               {"--frames-out"},
                                               {"--ping-pong=maybe"},
                                               {"--split", "half"}}) {
        std::vector<const char*> all{"paim-play", "a.paim"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        Options options;
        testing::internal::CaptureStderr();
        const int code = parse_options(static_cast<int>(all.size()), all.data(), options);
        const std::string message = testing::internal::GetCapturedStderr();
        EXPECT_EQ(code, static_cast<int>(ExitCode::usage)) << arguments[0];
        const std::string name = arguments[0];
        EXPECT_NE(message.find(name.substr(0, name.find('='))), std::string::npos) << message;
    }
}

}  // namespace
}  // namespace paim::player
