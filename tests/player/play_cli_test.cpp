// paim-play as a user runs it: pictures, exit codes, messages, the window.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "paim/base/file.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/format/paim/paim_read.h"
#include "paim/format/paim/paim_write.h"
#include "paim/image/exr.h"
#include "paim/light/environment.h"
#include "paim/light/sky.h"
#include "paim/mesh/planes.h"
#include "player/view/framing.h"
#include "tests/cli/run_tool.h"
#include "tests/exr_files.h"
#include "tests/player/ray_cast.h"
#include "tests/player/test_asset.h"
#include "tests/player/x_server.h"
#include "tests/temporary_directory.h"

namespace paim::player {
namespace {

class PlayTest : public testing::Test {
  protected:
    PlayTest() {
        // Tests do not use the display of the user who runs them.
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        TestAssetOptions options;  // 5 bands, 3 + 5 components, 6 poses
        asset_ = make_test_asset(options);
        write_paim(file_, asset_);
    }

    ToolResult play(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), {PAIM_PLAY, file_.string()});
        return run_tool(arguments);
    }

    // Expects the exit code, one message that holds the text, and nothing on standard output.
    void expect_failure(const std::vector<std::string>& arguments, int exit_code,
                        const std::string& text) const {
        const ToolResult result = play(arguments);
        EXPECT_EQ(result.exit_code, exit_code) << result.err;
        EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
        EXPECT_EQ(result.out, "");
    }

    std::string out(const char* name) const { return (directory_ / name).string(); }

    TemporaryDirectory directory_;
    std::filesystem::path file_ = directory_ / "ball.paim";
    Asset asset_;
};

// The picture by the library alone: default camera, built-in sky.
Image expected_picture(const Asset& asset, double time, double rotation_rad, int width, int height,
                       const Vec3f& background) {
    DecodedPose pose;
    const CodedMesh& mesh = asset.moving();
    MeshDecoder(mesh).decode(time, {}, pose);
    const LightCoefficients light = turn_about_y(
        EnvironmentLight(make_sky()).coefficients(static_cast<int>(mesh.layout.in_bands)),
        rotation_rad);
    const Camera camera = frame_asset(asset, kDefaultAzimuth_rad, kDefaultElevation_rad,
                                      static_cast<float>(width) / static_cast<float>(height));
    return ray_cast(mesh.topology, from_planes(pose.positions),
                    vertex_radiance(mesh, time, {}, light), camera, width, height, background);
}

TEST_F(PlayTest, SnapshotIsThePictureOfTheLibrary) {
    const ToolResult result =
        play({"--snapshot", out("a.exr"), "--pose", "1.5", "--env-rotation", "-40", "--size",
              "120x80", "--background", "0.1,0.2,0.3", "--supersample", "3", "--exposure", "3"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    const Image expected = downsample(
        expected_picture(asset_, 1.5, -40.0 * kPi / 180.0, 360, 240, Vec3f(0.1f, 0.2f, 0.3f)), 3);
    // EXR stays linear at any exposure. The limits are those the player promises.
    const Difference difference = compare(expected, read_exr(out("a.exr")));
    EXPECT_LE(difference.mean_relative, 1e-3);
    EXPECT_LE(difference.fraction_off, 0.005);
}

// To the byte: scaling by powers of two is exact, and the player undoes it before anything else.
TEST_F(PlayTest, PicturesDoNotDependOnTheSize) {
    TestAssetOptions still_options;
    still_options.geometry_components = still_options.transfer_components = 0;
    const CodedMesh still = stand_still(make_test_asset(still_options).moving(), 1.2f);
    struct Case {
        Precision precision;
        std::vector<std::string> arguments;
    };
    for (const Case& c : {Case{Precision::f32, {}},
                          Case{Precision::f32, {"--camera", "100,40,2.5", "--progressive"}},
                          Case{Precision::i16, {"--camera", "-30,-20"}}}) {
        TestAssetOptions options;
        options.precision = c.precision;
        Asset asset = make_test_asset(options);
        asset.parts.push_back(still);
        std::vector<std::string> arguments{"--snapshot", out("a.exr"), "--size", "64x48"};
        arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
        Image unscaled;
        for (const int exponent : {0, -90, -70, 70, 90, 124}) {
            Asset scaled = asset;
            scale_asset(scaled, exponent);
            write_paim(file_, scaled);
            const ToolResult result = play(arguments);
            ASSERT_EQ(result.exit_code, 0) << result.err;
            const Image image = read_exr(out("a.exr"));
            if (exponent == 0) unscaled = image;
            EXPECT_TRUE(image.pixels == unscaled.pixels) << exponent;
        }
        // The mesh is there to be seen.
        arguments.insert(arguments.end(), {"--background", "black"});
        ASSERT_EQ(play(arguments).exit_code, 0);
        const Image seen = read_exr(out("a.exr"));
        const auto num_seen = std::count_if(seen.pixels.begin(), seen.pixels.end(),
                                            [](const Vec3f& pixel) { return !pixel.isZero(0.0f); });
        EXPECT_GT(num_seen, 64 * 48 / 50);
    }
}

TEST_F(PlayTest, SnapshotsAreRepeatableAndPngsWritten) {
    for (const char* name : {"a.png", "b.png"}) {
        const ToolResult result = play({"--snapshot", out(name), "--size", "64x48"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
    }
    const auto size_bytes = std::filesystem::file_size(out("a.png"));
    EXPECT_GT(size_bytes, 500u);
    EXPECT_EQ(read_file(out("a.png"), size_bytes), read_file(out("b.png"), size_bytes));
}

// The background is 8: white after clamping. Neither other curve shows it as white at this exposure.
TEST_F(PlayTest, ToneCurvesChangeBrightPngs) {
    const Image bright(4, 2, Vec3f::Constant(8.0f));
    write_exr(out("bright.exr"), bright);
    std::vector<std::vector<uint8_t>> files;
    for (const char* name : {"clamp", "reinhard", "aces"}) {
        const ToolResult result =
            play({"--snapshot", out("a.png"), "--size", "32x24", "--env", out("bright.exr"),
                  "--exposure", "-1", "--tone-map", name, "--camera", "29,17,3", "--json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(nlohmann::json::parse(result.out)["tone_map"], name);
        const bool clipped = result.err.find("brighter than white") != std::string::npos;
        EXPECT_EQ(clipped, std::string(name) == "clamp") << result.err;
        const auto bytes = read_file(out("a.png"), std::filesystem::file_size(out("a.png")));
        files.emplace_back(bytes.begin(), bytes.end());
    }
    EXPECT_NE(files[0], files[1]);
    EXPECT_NE(files[1], files[2]);
    EXPECT_NE(files[0], files[2]);
}

TEST_F(PlayTest, SnapshotReportsAsJson) {
    const ToolResult result = play({"--snapshot", out("a.png"), "--size", "32x24", "--pose", "2.5",
                                    "--transfer-components", "2", "--bands", "3", "--decoder",
                                    "gpu", "--camera", "29,17,3", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.err, "");
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["file"], file_.string());
    EXPECT_EQ(json["snapshot"], out("a.png"));
    EXPECT_EQ(json["pose"], 2.5);
    EXPECT_EQ(json["tone_map"], "clamp");
    EXPECT_EQ(json["geometry_components"], 3);
    EXPECT_EQ(json["transfer_components"], 2);
    EXPECT_EQ(json["bands"], 3);
    EXPECT_EQ(json["codec"], "svd");
    EXPECT_EQ(json["cluster_multiply_adds"], 0);
    // f32 in texels of four: 1 + 3 of geometry, (1 + 2) of 3 for the transfer's 9 planes; the empty
    // texture of 8-bit components of both; weights, light, albedo.
    EXPECT_EQ(json["texture_bytes"], 16 * (4 + 3 * 3) * asset_.moving().topology.num_vertices +
                                         2 * 4 + 4 * (3 + 2) + 16 * 3 * 3 + 16);
    EXPECT_EQ(json["size"], nlohmann::json({32, 24}));
    EXPECT_EQ(json["multiply_adds_per_vertex"], 3 * 4 + 3 * 9 + 3 * 9);
    EXPECT_FALSE(json["renderer"].get<std::string>().empty());
}

TEST_F(PlayTest, LimitsBeyondTheFileAreLoweredWithANote) {
    const ToolResult result =
        play({"--snapshot", out("a.png"), "--size", "32x24", "--transfer-components", "99",
              "--geometry-components", "3", "--cluster-components", "2", "--bands", "6", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("--transfer-components 99: the file has 5"), std::string::npos);
    EXPECT_NE(result.err.find("--bands 6: the file has 5"), std::string::npos);
    EXPECT_NE(result.err.find("--cluster-components 2: the file has 0"), std::string::npos);
    EXPECT_EQ(result.err.find("--geometry-components"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(result.out)["transfer_components"], 5);
}

// Clusters of integers through the file, the decoder of the CPU and the shader.
TEST_F(PlayTest, PlaysClusters) {
    TestAssetOptions options;
    options.channels = 3;
    options.precision = Precision::i16;
    options.component_precisions = {Precision::i16, Precision::i8};
    options.num_clusters = 7;
    options.cluster_components = 6;
    options.coefficient_precisions = {Precision::i16, Precision::i16, Precision::i8};
    asset_ = make_test_asset(options);
    write_paim(file_, asset_);
    const std::vector<std::string> arguments{"--snapshot",    out("a.exr"), "--pose", "2.5",
                                             "--background",  "0,0,0",      "--size", "120x80",
                                             "--supersample", "1",          "--json"};
    const ToolResult result = play(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Image image = read_exr(out("a.exr"));
    const Difference difference =
        compare(expected_picture(asset_, 2.5, 0.0, 120, 80, Vec3f::Zero()), image);
    EXPECT_LE(difference.mean_relative, 1e-3);
    EXPECT_LE(difference.fraction_off, 0.005);
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["codec"], "cpca");
    EXPECT_EQ(json["clusters"], 7);
    EXPECT_EQ(json["cluster_components"], 6);
    EXPECT_EQ(json["multiply_adds_per_vertex"], 3 * 4 + 3 * 7);
    EXPECT_EQ(json["cluster_multiply_adds"], 49 * (75 * 5 + 3 * 25));

    std::vector<std::string> fewer = arguments;
    fewer.insert(fewer.end(), {"--cluster-components", "1"});
    const ToolResult coarse = play(fewer);
    ASSERT_EQ(coarse.exit_code, 0) << coarse.err;
    EXPECT_EQ(nlohmann::json::parse(coarse.out)["cluster_components"], 1);
    EXPECT_GT(compare(image, read_exr(out("a.exr"))).mean_relative, 1e-3);

    const ToolResult bench = play({"--bench", "2", "--size", "64x48", "--json"});
    ASSERT_EQ(bench.exit_code, 0) << bench.err;
    EXPECT_GT(nlohmann::json::parse(bench.out)["cpu_min_ms"], 0.0);
    EXPECT_NE(play({"--bench", "2", "--size", "64x48"}).out.find("for the bases of clusters"),
              std::string::npos);
}

// The same light as a lat-long map and as a cube map: the same picture, background and all.
TEST_F(PlayTest, CubeMapsLightLikeLatLongMaps) {
    const auto radiance = [](const Vec3d& direction) {
        const Vec3f d = direction.normalized().cast<float>();
        return Vec3f(Vec3f(0.5f, 0.4f, 0.3f) + 0.3f * d + 0.2f * Vec3f(d.y() * d.z(), 0, d.x()));
    };
    constexpr int kFace = 128;
    Image cube(kFace, 6 * kFace);
    for (int y = 0; y < cube.height; ++y) {
        for (int x = 0; x < kFace; ++x) {
            const double right = (2.0 * x + 1.0) / kFace - 1.0;
            const double up = 1.0 - (2.0 * (y % kFace) + 1.0) / kFace;
            const std::vector<Vec3d> faces{{1, up, right},   {-1, up, -right}, {right, 1, up},
                                           {right, -1, -up}, {-right, up, 1},  {right, up, -1}};
            cube.at(x, y) = radiance(faces[static_cast<size_t>(y / kFace)]);
        }
    }
    Image latlong(512, 256);
    for (int y = 0; y < 256; ++y) {
        for (int x = 0; x < 512; ++x) {
            latlong.at(x, y) = radiance(direction_from_latlong((x + 0.5) / 512, (y + 0.5) / 256));
        }
    }
    write_exr_with(out("cube.exr"), cube, mark_as_cube);
    write_exr_with(out("latlong.exr"), latlong);
    const auto picture = [&](const char* map, const std::string& camera, const char* mapping) {
        const ToolResult result = play({"--env", out(map), "--snapshot", out("a.exr"), "--size",
                                        "96x64", "--camera", camera, "--env-mapping", mapping});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        EXPECT_EQ(result.err.empty(),
                  std::string(map) != "cube.exr" || std::string(mapping) == "auto")
            << result.err;
        return read_exr(out("a.exr"));
    };
    for (const std::string camera : {"30,20", "-120,-40", "200,80"}) {
        const Image expected = picture("latlong.exr", camera, "auto");
        // Half a pixel of the cube at most.
        EXPECT_LE(compare(expected, picture("cube.exr", camera, "auto")).mean_relative, 3e-3);
        EXPECT_GT(compare(expected, picture("cube.exr", camera, "latlong")).mean_relative, 0.05);
    }
}

// A note says what was assumed.
TEST_F(PlayTest, SaysHowAMapWasRead) {
    write_exr_with(out("square.exr"), Image(6, 6, Vec3f::Ones()));
    const ToolResult result =
        play({"--env", out("square.exr"), "--snapshot", out("a.exr"), "--size", "16x16"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err.find("paim-play: note: " + out("square.exr") + ": 6 x 6 pixels"), 0u)
        << result.err;
    expect_failure(
        {"--env", out("square.exr"), "--env-mapping", "cube", "--snapshot", out("a.exr")}, 2,
        "square.exr: expected N x 6 N pixels");
    expect_failure({"--env-mapping", "ball"}, 1, "--env-mapping: expected one of auto, latlong");
}

// What is read stays, and no output takes the place of another.
TEST_F(PlayTest, RefusesOutputsThatReplaceOtherFiles) {
    write_exr(out("light.exr"), Image(4, 2, Vec3f::Ones()));
    const auto contents = [&] { return read_file(file_, std::filesystem::file_size(file_)); };
    const std::vector<char> before = contents();
    expect_failure({"--snapshot", out("a.png"), "--save-view", file_.string()}, 1,
                   "that is the model");
    expect_failure({"--snapshot", out("x/../light.exr"), "--env", out("light.exr")}, 1,
                   "that is the light");
    expect_failure({"--snapshot", out("a.png"), "--save-view", out("a.png")}, 1,
                   "that is the file of --snapshot");
    EXPECT_EQ(contents(), before);
    EXPECT_EQ(read_exr(out("light.exr")).pixels[0], Vec3f(Vec3f::Ones()));
    EXPECT_FALSE(std::filesystem::exists(out("a.png")));
}

TEST_F(PlayTest, RefusesClipsOfTooManyPictures) {
    expect_failure({"--frames-out", out("clip"), "--fps", "1000", "--seconds", "1e5"}, 1,
                   "at most 99999 pictures");
    EXPECT_FALSE(std::filesystem::exists(out("clip")));
}

TEST_F(PlayTest, RefusesCommandLinesThatMakeNoSense) {
    const std::string png = out("a.png");
    expect_failure({"--snapshot", png, "--pose", "5.01"}, 1, "--pose: expected 0 to 5");
    expect_failure({"--snapshot", png, "--pose", "-1"}, 1, "--pose: expected a number from 0");
    expect_failure({"--snapshot", png, "--pose", "nan"}, 1, "--pose");
    expect_failure({"--geometry-components", "-1"}, 1, "--geometry-components: expected a whole");
    expect_failure({"--transfer-components", "1.5"}, 1, "--transfer-components: expected a whole");
    expect_failure({"--cluster-components", "-1"}, 1, "--cluster-components: expected a whole");
    expect_failure({"--bands", "0"}, 1, "--bands: expected a whole number from 1");
    expect_failure({"--exposure", "31"}, 1, "--exposure: expected a number from -30 to 30");
    expect_failure({"--gamma", "-2"}, 1, "--gamma");
    expect_failure({"--tone-map", "filmic"}, 1,
                   "--tone-map: expected one of clamp, reinhard, aces, got 'filmic'");
    expect_failure({"--size", "0x5"}, 1, "--size: expected WIDTHxHEIGHT");
    expect_failure({"--supersample", "9"}, 1, "--supersample: expected a whole number from 1 to 8");
    expect_failure({"--background", "blue"}, 1, "--background");
    expect_failure({"--camera", "10"}, 1, "--camera: expected AZIMUTH,ELEVATION");
    expect_failure({"--camera", "10,90"}, 1, "--camera elevation: expected a number from -89");
    expect_failure({"--camera", "10,20,0"}, 1, "--camera distance factor");
    expect_failure({"--snapshot", out("a.jpg")}, 1, "ends in .png or .exr");
    expect_failure({"--snapshot", png, "--bench", "3"}, 1, "exclude each other");
    expect_failure({"--json"}, 1, "--json needs --snapshot, --frames-out or --bench");
    expect_failure({"--nonsense"}, 1, "--nonsense");
    EXPECT_FALSE(std::filesystem::exists(png));
}

TEST_F(PlayTest, NamesFilesThatCannotBeReadOrWritten) {
    expect_failure({"--env", out("none.exr"), "--snapshot", out("a.png")}, 2, "none.exr");
    expect_failure({"--env", file_.string(), "--snapshot", out("a.png")}, 2, "ball.paim");
    expect_failure({"--snapshot", out("none/a.png"), "--size", "8x8"}, 4, "none/a.png");
    write_exr(out("bad.exr"), Image(4, 2, Vec3f::Constant(-1.0f)));
    expect_failure({"--env", out("bad.exr"), "--snapshot", out("a.png")}, 2, "bad.exr");
    const ToolResult missing = run_tool({PAIM_PLAY, out("none.paim"), "--snapshot", out("a.png")});
    EXPECT_EQ(missing.exit_code, 2);
    EXPECT_NE(missing.err.find("none.paim"), std::string::npos) << missing.err;
}

// 131,072 samples a row are more than any driver draws at once.
TEST_F(PlayTest, DrawsEverySizeWithEverySupersampling) {
    for (const char* const name : {"a.png", "a.exr"}) {
        const ToolResult result =
            play({"--snapshot", out(name), "--size", "16384x3", "--supersample", "8", "--json"});
        ASSERT_EQ(result.exit_code, 0) << result.err;
        const auto json = nlohmann::json::parse(result.out);
        EXPECT_EQ(json["size"], nlohmann::json({16384, 3}));
        EXPECT_EQ(json["supersample"], 8);
    }
    const Image picture = read_exr(out("a.exr"));
    EXPECT_EQ(picture.width, 16384);
    EXPECT_EQ(picture.height, 3);
    const ToolResult bench =
        play({"--bench", "1", "--size", "3x16384", "--supersample", "8", "--json"});
    EXPECT_EQ(bench.exit_code, 0) << bench.err;
}

TEST_F(PlayTest, SaysWhatIsMissingToDraw) {
    expect_failure({}, 3, "--snapshot");
    ::setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
    expect_failure({"--snapshot", out("a.png")}, 3, "EGL_MESA_platform_surfaceless");
    ::unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
}

TEST_F(PlayTest, HelpNamesEveryOptionAndKey) {
    const ToolResult result = run_tool({PAIM_PLAY, "--help"});
    EXPECT_EQ(result.exit_code, 0);
    for (const char* word : {"--env",
                             "--env-mapping",
                             "--env-rotation",
                             "--background",
                             "--geometry-components",
                             "--transfer-components",
                             "--cluster-components",
                             "--bands",
                             "--pose",
                             "--camera",
                             "--size",
                             "--supersample",
                             "--exposure",
                             "--gamma",
                             "--tone-map",
                             "--snapshot",
                             "--bench",
                             "--frames",
                             "--json",
                             "--progressive",
                             "Space",
                             "Esc",
                             "degrees",
                             "pixels"}) {
        EXPECT_NE(result.out.find(word), std::string::npos) << word;
    }
}

TEST_F(PlayTest, BenchReportsTimes) {
    const ToolResult result = play({"--bench", "5", "--size", "64x48", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["frames"], 5);
    for (const char* name : {"frame", "vertices", "cpu"}) {
        const double median_ms = json[std::string(name) + "_median_ms"];
        const double min_ms = json[std::string(name) + "_min_ms"];
        EXPECT_GT(min_ms, 0.0) << name;
        EXPECT_LE(min_ms, median_ms) << name;
    }
    EXPECT_NEAR(json["vertices_to_cpu_ratio"].get<double>() * json["cpu_median_ms"].get<double>(),
                json["vertices_median_ms"].get<double>(), 1e-9);
}

TEST_F(PlayTest, WindowOpensPlaysAndCloses) {
    const XServer server(PAIM_XVFB);
    const ToolResult result = play({"--frames", "12", "--size", "320x240", "--supersample", "2"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace paim::player
