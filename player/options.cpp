// paim-play's options: one description each, with unit, range and default.
#include "player/options.h"

#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "paim/base/error.h"
#include "paim/cli/light_options.h"
#include "paim/cli/parse.h"
#include "player/ui/keys.h"

namespace paim::player {

namespace {

// As typed; checked and converted afterwards. An option that is not given holds nothing.
struct RawOptions {
    std::string model;
    std::optional<std::string> environment, size, background, camera, snapshot, tone_map;
    std::optional<double> pose, env_rotation, supersample, exposure, gamma;
    std::optional<double> geometry_components, transfer_components, bands;
    // One for each of codec_words().
    std::vector<std::optional<double>> vertex_components =
        std::vector<std::optional<double>>(codec_words().size());
    std::optional<double> bench, frames;
};

constexpr int kMaxCount = 1000000000;

void require_range(const char* option, double value, double lowest, double highest) {
    if (value >= lowest && value <= highest) return;  // false for NaN
    throw_usage("{}: expected a number from {} to {}, got {}", option, lowest, highest, value);
}

double number_in_range(const char* option, std::optional<double> value, double lowest,
                       double highest, double otherwise) {
    if (!value) return otherwise;
    require_range(option, *value, lowest, highest);
    return *value;
}

std::optional<int> integer_in_range(const char* option, std::optional<double> value, int lowest,
                                    int highest) {
    if (!value) return std::nullopt;
    if (*value >= lowest && *value <= highest && *value == std::floor(*value)) {
        return static_cast<int>(*value);
    }
    throw_usage("{}: expected a whole number from {} to {}, got {}", option, lowest, highest,
                *value);
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

// Adds options to one group of --help. Each is described in one place, so that --help is their
// documentation.
class OptionGroup {
  public:
    OptionGroup(CLI::App& app, std::string name) : app_(app), name_(std::move(name)) {}

    template <typename Value>
    void add(const char* name, Value& value, const char* unit, const char* text) {
        app_.add_option(name, value, text)->type_name(unit)->group(name_);
    }
    void add_flag(const char* name, bool& value, const char* text) {
        app_.add_flag(name, value, text)->group(name_);
    }

  private:
    CLI::App& app_;
    std::string name_;
};

void describe_picture(CLI::App& app, RawOptions& raw, Options& options) {
    app.add_option("model", raw.model, "The compressed animation to play")
        ->type_name("X.paim")
        ->required();
    OptionGroup group(app, "Picture");
    group.add("--snapshot", raw.snapshot, "OUT.png|OUT.exr",
              "Draw one picture into this file instead of opening a window; needs neither a "
              "display nor a GPU");
    group.add("--size", raw.size, "WxH",
              "Width and height of the picture or window in pixels, 1 to 16384 each (default: "
              "1280x720)");
    group.add("--pose", raw.pose, "P",
              "Pose to show, or to start playing from: 0 is the first, a fraction lies between two "
              "poses (default: 0)");
    group.add(
        "--camera", raw.camera, "AZ,EL[,F]",
        "Where the camera stands. AZ: azimuth about +Y in degrees, -360 to 360, 0 looks along "
        "-Z. EL: elevation in degrees, -89 to 89. F: distance, as a factor from 0.05 to 100 "
        "of the distance from which all poses are seen (default: 28.65,17.19,1)");
    group.add(
        "--env", raw.environment, "FILE.exr",
        "Light and background: an OpenEXR image of linear radiance that shows every direction, "
        "such as a latitude-longitude map (default: a built-in sky)");
    cli::add_env_mapping(app, options.env_mapping)->group("Picture");
    group.add("--env-rotation", raw.env_rotation, "DEG",
              "Angle by which light and background are turned about +Y, in degrees, -36000 to "
              "36000, counter-clockwise seen from above (default: 0)");
    group.add("--background", raw.background, "env|black|R,G,B",
              "Background: the environment, black, or a colour of linear radiance, each channel 0 "
              "to 1 (default: env)");
    group.add(
        "--exposure", raw.exposure, "EV",
        "Multiply radiance by 2^EV before it is displayed, -30 to 30 stops; for PNG files and "
        "the window, OpenEXR files keep linear radiance (default: 0)");
    group.add("--tone-map", raw.tone_map, "clamp|reinhard|aces",
              "How radiance x of each channel, after --exposure, is fitted to what a display can "
              "show; for PNG files and the window. clamp: all above 1 is white. reinhard: x/(1+x). "
              "aces: a film-like curve, white from 7.2 on (default: clamp)");
    group.add("--gamma", raw.gamma, "G",
              "Display curve x^(1/G), 0.1 to 10, or 0 for the sRGB curve; for PNG files and the "
              "window (default: 0)");
    group.add(
        "--supersample", raw.supersample, "N",
        "Average N x N samples for each pixel, 1 to 8. Pictures of any --size can have all of "
        "them; a window has no more than fit into the driver's largest picture (default: 2 "
        "with --snapshot, otherwise 1)");
}

void describe_detail(CLI::App& app, RawOptions& raw, Options& options) {
    OptionGroup group(app, "Detail (a note says so where the file has less)");
    group.add("--transfer-components", raw.transfer_components, "K",
              "Number of components that transfer is rebuilt from, 0 or more (default: all)");
    group.add("--geometry-components", raw.geometry_components, "K",
              "Number of components that vertex positions are rebuilt from, 0 or more (default: "
              "all)");
    for (size_t j = 0; j < raw.vertex_components.size(); ++j) {
        const CodecWords& words = codec_words()[j];
        group.add(words.option, raw.vertex_components[j], "K", words.description);
    }
    group.add("--bands", raw.bands, "B",
              "Number of spherical-harmonic bands of transfer and light, 1 or more; B bands are "
              "B*B coefficients (default: all)");
    group.add_flag("--progressive", options.play_prefix,
                   "Play a file that is still being written or downloaded: the window opens as "
                   "soon as the first part of the file that can be played has arrived, and shows "
                   "more detail as more arrives. It gives up if nothing arrives for 30 seconds "
                   "before that. --snapshot and --bench use what is there now (default: an "
                   "incomplete file is refused)");
}

void describe_runs(CLI::App& app, RawOptions& raw, Options& options) {
    OptionGroup group(app, "Measuring and scripts");
    group.add("--bench", raw.bench, "N",
              "Draw N frames without a display, 1 to 100000, while the animation plays and the "
              "light turns. Print the time of a frame, of its vertices alone, and of decoding and "
              "shading on the CPU");
    group.add("--frames", raw.frames, "N",
              "Close the window after N frames, 1 to 1000000000 (default: it stays open)");
    group.add_flag("--json", options.json,
                   "Print one JSON object on standard output and nothing else; needs --snapshot or "
                   "--bench");
}

constexpr const char* kExamples =
    "Examples:\n"
    "  paim-play character.paim\n"
    "      opens a window that plays the animation under the built-in sky\n"
    "  paim-play character.paim --env studio.exr --snapshot picture.png --pose 12 --camera 60,20\n"
    "      draws pose 12 under another light into a file\n";

std::filesystem::path picture_path(const std::string& text) {
    std::filesystem::path path = text;
    if (path.extension() != ".png" && path.extension() != ".exr") {
        throw_usage("--snapshot: expected a file name that ends in .png or .exr, got '{}'", text);
    }
    return path;
}

void convert_picture(const RawOptions& raw, Options& options) {
    if (raw.snapshot) options.snapshot_path = picture_path(*raw.snapshot);
    if (raw.size) options.size = cli::parse_size(*raw.size, "--size");
    options.pose = number_in_range("--pose", raw.pose, 0.0, kMaxCount, 0.0);
    if (raw.camera) options.camera = parse_camera(*raw.camera);
    if (raw.environment) options.environment_path = *raw.environment;
    options.env_rotation_rad =
        radians(number_in_range("--env-rotation", raw.env_rotation, -36000.0, 36000.0, 0.0));
    if (raw.background) options.background = parse_background(*raw.background);
    const double exposure = number_in_range("--exposure", raw.exposure, -30.0, 30.0, 0.0);
    const double gamma =
        raw.gamma == 0.0 ? 0.0 : number_in_range("--gamma (or 0)", raw.gamma, 0.1, 10.0, 0.0);
    options.tone_curve = {static_cast<float>(exposure), static_cast<float>(gamma)};
    if (raw.tone_map) options.tone_curve.tone_operator = parse_tone_operator(*raw.tone_map);
    options.supersample = integer_in_range("--supersample", raw.supersample, 1, 8);
}

void convert_detail(const RawOptions& raw, Options& options) {
    const auto limit = [](const char* name, std::optional<double> value,
                          int lowest) -> std::optional<uint32_t> {
        const std::optional<int> count = integer_in_range(name, value, lowest, kMaxCount);
        if (!count) return std::nullopt;
        return static_cast<uint32_t>(*count);
    };
    WantedLimits& wanted = options.wanted;
    wanted.geometry_components = limit("--geometry-components", raw.geometry_components, 0);
    wanted.transfer_components = limit("--transfer-components", raw.transfer_components, 0);
    for (size_t j = 0; j < raw.vertex_components.size(); ++j) {
        const CodecWords& words = codec_words()[j];
        const auto count = limit(words.option, raw.vertex_components[j], 0);
        if (count) wanted.vertex_components = {&words, *count};
    }
    wanted.bands = limit("--bands", raw.bands, 1);
}

}  // namespace

DecodeLimits WantedLimits::limits() const {
    DecodeLimits limits;  // all there is
    limits.geometry_components = geometry_components.value_or(limits.geometry_components);
    limits.transfer_components = transfer_components.value_or(limits.transfer_components);
    if (vertex_components) limits.vertex_components = vertex_components->count;
    limits.bands = bands.value_or(limits.bands);
    return limits;
}

int parse_options(int argc, const char* const* argv, Options& options) {
    RawOptions raw;
    CLI::App app(std::string("Plays a compressed animation (.paim) under a light that can be "
                             "changed and turned.\n\n") +
                     kExamples,
                 "paim-play");
    describe_picture(app, raw, options);
    describe_detail(app, raw, options);
    describe_runs(app, raw, options);
    app.set_help_flag("-h,--help", "Print this help and quit");  // once more, to be listed last
    app.set_version_flag("--version", cli::version_text("paim-play"), "Print the version and quit");
    app.footer(keys_help() +
               "\nMouse: drag to turn the camera, drag with the right or middle button to move it, "
               "turn the wheel to come closer. Drop an .exr file onto the window to change the "
               "light.\n"
               "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed.");
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;

    options.model_path = raw.model;
    convert_picture(raw, options);
    convert_detail(raw, options);
    options.bench_frames = integer_in_range("--bench", raw.bench, 1, 100000);
    options.window_frames = integer_in_range("--frames", raw.frames, 1, kMaxCount);
    const int num_modes = options.snapshot_path.has_value() + options.bench_frames.has_value() +
                          options.window_frames.has_value();
    if (num_modes > 1) throw_usage("--snapshot, --bench and --frames exclude each other");
    if (options.json && options.opens_window()) {
        throw_usage("--json needs --snapshot or --bench");
    }
    return -1;
}

}  // namespace paim::player
