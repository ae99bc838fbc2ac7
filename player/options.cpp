// paim-play's options: one description each, with unit, range and default.
#include "player/options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <system_error>

#include "paim/base/error.h"
#include "paim/cli/parse.h"
#include "player/ui/keys.h"

namespace paim::player {

namespace {

// As typed; checked and converted afterwards.
struct RawOptions {
    std::string model, environment, size, background, camera, snapshot;
    double geometry_components = 0, transfer_components = 0, cluster_components = 0, bands = 0;
    double exposure = 0, gamma = 0, pose = 0, env_rotation = 0;
    double supersample = 0, bench = 0, frames = 0;
};

void require_range(const char* option, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;  // false for NaN
    throw_usage("{}: expected a number from {} to {}, got {}", option, lowest, highest, value);
}

int integer_in_range(const char* option, double value, int lowest, int highest) {
    if (value >= lowest && value <= highest && value == std::floor(value)) {
        return static_cast<int>(value);
    }
    throw_usage("{}: expected a whole number from {} to {}, got {}", option, lowest, highest,
                value);
}

double radians(double degrees) {
    return degrees * kPi / 180.0;
}

Background parse_background(const std::string& text) {
    if (text == "env") return {};
    if (text == "black") return {Background::Kind::color, Vec3f::Zero()};
    return {Background::Kind::color, cli::parse_color(text, "--background (env, black or R,G,B)")};
}

CameraOptions parse_camera(const std::string& text) {
    std::array<double, 3> values{0.0, 0.0, 1.0};
    size_t count = 0;
    const char* at = text.data();
    const char* const end = at + text.size();
    bool valid = true;
    while (valid && count < values.size()) {
        const auto [rest, failure] = std::from_chars(at, end, values[count++]);
        valid = failure == std::errc();
        at = rest;
        if (at == end || *at != ',') break;
        ++at;
    }
    if (!valid || at != end || count < 2 || text.ends_with(',')) {
        throw_usage("--camera: expected AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,FACTOR, got '{}'",
                    text);
    }
    require_range("--camera azimuth", values[0], -360.0, 360.0);
    require_range("--camera elevation", values[1], -89.0, 89.0);
    require_range("--camera distance factor", values[2], 0.05, 100.0);
    return {static_cast<float>(radians(values[0])), static_cast<float>(radians(values[1])),
            static_cast<float>(values[2])};
}

// What every option means. Kept in one place, so that --help is the documentation.
void describe(CLI::App& app, RawOptions& raw, Options& options) {
    const auto number = [&](const char* name, double& value, const char* unit, const char* text) {
        app.add_option(name, value, text)->type_name(unit);
    };
    const auto text = [&](const char* name, std::string& value, const char* unit,
                          const char* help) {
        return app.add_option(name, value, help)->type_name(unit);
    };
    text("model", raw.model, "X.paim", "The compressed animation to play")->required();
    app.add_flag("--json", options.json,
                 "Print one JSON object on standard output and nothing else; with --snapshot or "
                 "--bench");
    app.add_flag(
        "--progressive", options.progressive,
        "Play a file of which only the beginning is there: the window starts as soon as "
        "that can be played (gives up if no byte comes for 30 seconds before) and sharpens "
        "while the file grows; --snapshot and --bench take what is there now (default: a "
        "file that is cut short is refused)");

    text("--env", raw.environment, "FILE.exr",
         "Light and background: a lat-long OpenEXR map of linear radiance (default: a built-in "
         "sky)");
    number("--env-rotation", raw.env_rotation, "DEG",
           "Turns light and background about +Y, counter-clockwise seen from above; degrees, "
           "-36000 to 36000 (default 0)");
    text("--background", raw.background, "env|black|R,G,B",
         "What is behind the mesh: the environment, or a colour of linear radiance, each channel 0 "
         "to 1 (default env)");
    number("--geometry-components", raw.geometry_components, "K",
           "Components that positions are rebuilt from, 0 or more; a note says so where the file "
           "has fewer (default: all)");
    number("--transfer-components", raw.transfer_components, "K",
           "Components that transfer, or that of clusters' bases, is rebuilt from, 0 or more; "
           "likewise (default: all)");
    number(
        "--cluster-components", raw.cluster_components, "K",
        "Components of its cluster that a vertex's transfer is summed from, 0 or more, where the "
        "file has clusters; likewise (default: all)");
    number("--bands", raw.bands, "B",
           "Spherical-harmonic bands of transfer and light, 1 or more; B bands are B*B "
           "coefficients; likewise (default: all)");
    number("--pose", raw.pose, "P",
           "The pose to show, or to start with; 0 is the first, fractions interpolate "
           "(default 0)");
    text("--camera", raw.camera, "AZ,EL[,F]",
         "Azimuth about +Y, 0 looking along -Z, -360 to 360 degrees; elevation, -89 to 89 degrees; "
         "distance, as a factor from 0.05 to 100 of the one from which all poses are seen "
         "(default 28.65,17.19,1)");
    text("--size", raw.size, "WxH",
         "Picture or window, pixels, 1 to 16384 each (default 1280x720)");
    number("--supersample", raw.supersample, "N",
           "Average N x N samples for each pixel, 1 to 8 (default 2 with --snapshot, else 1)");
    number("--exposure", raw.exposure, "EV",
           "Scales radiance by 2^EV before display, stops, -30 to 30; PNG and window only, OpenEXR "
           "keeps linear radiance (default 0)");
    number("--gamma", raw.gamma, "G",
           "Display curve x^(1/G), 0.1 to 10, or 0 for the sRGB curve; PNG and window only "
           "(default 0)");

    text("--snapshot", raw.snapshot, "OUT.png|OUT.exr",
         "Draw one picture into this file and quit; needs neither display nor GPU");
    number("--bench", raw.bench, "N",
           "Draw N frames without a display, 1 to 100000, playing and turning the light, and "
           "report the time of a frame, of its vertices alone, and of decoding and shading them on "
           "the "
           "CPU");
    number("--frames", raw.frames, "N",
           "Quit after N frames in the window, 1 to 1000000000 (default: when it is closed)");
}

}  // namespace

int parse_options(int argc, const char* const* argv, Options& options) {
    RawOptions raw;
    CLI::App app(
        "Plays a pre-animated and illuminated model (.paim) under a light that can be changed and "
        "turned.",
        "paim-play");
    app.set_version_flag("--version", cli::version_text("paim-play"));
    describe(app, raw, options);
    app.footer(keys_help() +
               "\nMouse: drag to orbit, right or middle drag to move, wheel to zoom; drop an .exr "
               "onto the window to change the light.\n"
               "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed.");
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;
    const auto given = [&](const char* name) { return app.count(name) > 0; };

    constexpr int kMaxCount = 1000000000;
    options.model_path = raw.model;
    if (given("--env")) options.environment_path = raw.environment;
    const auto limit = [&](const char* name, double value, int lowest, uint32_t& out) {
        if (given(name)) {
            out = static_cast<uint32_t>(integer_in_range(name, value, lowest, kMaxCount));
        }
    };
    limit("--geometry-components", raw.geometry_components, 0, options.limits.geometry_components);
    limit("--transfer-components", raw.transfer_components, 0, options.limits.transfer_components);
    limit("--cluster-components", raw.cluster_components, 0, options.limits.cluster_components);
    limit("--bands", raw.bands, 1, options.limits.bands);
    options.wanted_limits = options.limits;

    require_range("--exposure", raw.exposure, -30.0, 30.0);
    if (raw.gamma != 0.0) require_range("--gamma (or 0)", raw.gamma, 0.1, 10.0);
    options.tone_curve = {static_cast<float>(raw.exposure), static_cast<float>(raw.gamma)};
    require_range("--pose", raw.pose, 0.0, kMaxCount);
    options.pose = raw.pose;
    require_range("--env-rotation", raw.env_rotation, -36000.0, 36000.0);
    options.env_rotation_rad = radians(raw.env_rotation);
    if (given("--size")) options.size = cli::parse_size(raw.size, "--size");
    if (given("--supersample")) {
        options.supersample = integer_in_range("--supersample", raw.supersample, 1, 8);
    }
    if (given("--background")) options.background = parse_background(raw.background);
    if (given("--camera")) options.camera = parse_camera(raw.camera);

    if (given("--bench")) options.bench_frames = integer_in_range("--bench", raw.bench, 1, 100000);
    if (given("--frames")) {
        options.window_frames = integer_in_range("--frames", raw.frames, 1, kMaxCount);
    }
    if (given("--snapshot")) {
        options.snapshot_path = raw.snapshot;
        const std::string extension = options.snapshot_path->extension().string();
        if (extension != ".png" && extension != ".exr") {
            throw_usage("--snapshot: expected a file name that ends in .png or .exr, got '{}'",
                        raw.snapshot);
        }
    }
    const int num_modes = given("--snapshot") + given("--bench") + given("--frames");
    if (num_modes > 1) throw_usage("--snapshot, --bench and --frames exclude each other");
    if (options.json && !given("--snapshot") && !given("--bench")) {
        throw_usage("--json goes with --snapshot or --bench");
    }
    return -1;
}

}  // namespace paim::player
