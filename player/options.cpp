// paim-play's options: one description each, with unit, range and default.
#include "player/options.h"

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "paim/base/error.h"
#include "paim/cli/light_options.h"
#include "paim/cli/parse.h"
#include "player/option_group.h"
#include "player/ui/keys.h"

namespace paim::player {

namespace {

// As typed; checked and converted afterwards. An option that is not given holds nothing.
struct RawOptions {
    std::string model;
    std::optional<std::string> environment, size, camera, target, snapshot, frames_out, view,
        save_view;
    std::optional<double> supersample, geometry_components, transfer_components, bands;
    // One for each of codec_words().
    std::vector<std::optional<double>> vertex_components =
        std::vector<std::optional<double>>(codec_words().size());
    std::optional<double> bench, frames, fps, seconds;
};

constexpr int kMaxCount = 1000000000;

double radians(double degrees) {
    return degrees * kPi / 180.0;
}

CameraOptions parse_camera(const std::string& text) {
    const std::vector<double> values =
        parse_numbers("--camera", text, 2, 3, "AZIMUTH,ELEVATION or AZIMUTH,ELEVATION,FACTOR");
    require_range("--camera azimuth", values[0], -360.0, 360.0);
    require_range("--camera elevation", values[1], -89.0, 89.0);
    const double factor = values.size() == 3 ? values[2] : 1.0;
    require_range("--camera distance factor", factor, 0.05, 100.0);
    return {std::remainder(radians(values[0]), 2.0 * kPi), radians(values[1]), factor};
}

TargetOptions parse_target(const std::string& text) {
    if (text == "all") return {CameraTarget::all};
    if (text == "pose") return {CameraTarget::pose};
    const std::vector<double> values =
        parse_numbers("--camera-target", text, 3, 3, "all, pose or X,Y,Z");
    for (const double value : values) require_range("--camera-target", value, -1e30, 1e30);
    return {CameraTarget::point, {values[0], values[1], values[2]}};
}

void describe_files(CLI::App& app, RawOptions& raw, Options& options) {
    app.add_option("model", raw.model, "The compressed animation to play")
        ->type_name("X.paim")
        ->required();
    OptionGroup group(app, "Files");
    group.add(
        "--env", raw.environment, "FILE.exr",
        "Light and background: an OpenEXR image of linear radiance that shows every direction, "
        "such as a latitude-longitude map (default: a built-in sky)");
    cli::add_env_mapping(app, options.env_mapping)->group("Files");
    group.add("--snapshot", raw.snapshot, "OUT.png|OUT.exr",
              "Draw one picture into this file instead of opening a window; needs neither a "
              "display nor a GPU");
    group.add("--frames-out", raw.frames_out, "DIR",
              "Draw a clip into this folder, NAME_00001.png and on, instead of opening a window: "
              "what the window would show while the animation plays and light or camera turn; "
              "needs neither a display nor a GPU");
    group.add("--fps", raw.fps, "N",
              "Pictures of the clip for each second, 0.01 to 1000 (default: the rate of the file)");
    group.add(
        "--seconds", raw.seconds, "S",
        "Length of the clip, 0.001 to 100000 seconds and at most 99999 pictures (default: once "
        "through the animation)");
    group.add("--view", raw.view, "FILE.json",
              "Start from a view that was saved before; other options change it");
    group.add(
        "--save-view", raw.save_view, "FILE.json",
        "Save the view: that of the picture or clip, or that of the window when it is closed");
}

void describe_picture(CLI::App& app, RawOptions& raw) {
    OptionGroup group(app, "Picture");
    group.add("--size", raw.size, "WxH",
              "Width and height of the picture or window in pixels, 1 to 16384 each (default: "
              "1280x720)");
    group.add(
        "--supersample", raw.supersample, "N",
        "Average N x N samples for each pixel, 1 to 8. Pictures of any --size can have all of "
        "them; a window has no more than fit into the driver's largest picture (default: 2 "
        "with --snapshot and --frames-out, otherwise 1)");
    group.add(
        "--camera", raw.camera, "AZ,EL[,F]",
        "Where the camera stands. AZ: azimuth about +Y in degrees, -360 to 360, 0 looks along "
        "-Z. EL: elevation in degrees, -89 to 89. F: distance, as a factor from 0.05 to 100 "
        "of that from which the body fills 80 % of the picture's height or width in all poses "
        "(default: 28.65,17.19,1)");
    group.add("--camera-target", raw.target, "all|pose|X,Y,Z",
              "What the camera looks at: the middle of all poses, the body wherever it goes, or a "
              "point of the scene (default: all)");
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
    const std::vector<std::pair<std::string, Decoder>> decoders{
        {"auto", Decoder::automatic}, {"gpu", Decoder::gpu}, {"cpu", Decoder::cpu}};
    group.add_choice(
        "--decoder", options.decoder, decoders,
        "Where vertices are decoded and lit: in shaders (gpu) or by the CPU (cpu). "
        "auto: in shaders, but by the CPU where OpenGL is drawn by software or the GPU "
        "cannot hold the file");
    group.add_flag("--progressive", options.play_prefix,
                   "Play a file that is still being written or downloaded: the window opens as "
                   "soon as the first part of the file that can be played has arrived, and shows "
                   "more detail as more arrives. It gives up if nothing arrives for 30 seconds "
                   "before that. --snapshot and --bench use what is there now (default: an "
                   "incomplete file is refused)");
}

void describe_runs(CLI::App& app, RawOptions& raw, Options& options) {
    OptionGroup group(app, "Measuring and scripts");
    group.add(
        "--bench", raw.bench, "N",
        "Draw N frames without a display, 1 to 100000, while the animation plays and the "
        "light turns, and as many of a mesh of the same size that neither moves nor changes. "
        "Print the times of frames and of their vertices alone, their ratios, and the time of "
        "decoding and shading on the CPU");
    group.add("--frames", raw.frames, "N",
              "Close the window after N frames, 1 to 1000000000 (default: it stays open)");
    group.add_flag("--json", options.json,
                   "Print one JSON object on standard output and nothing else; needs --snapshot, "
                   "--frames-out or --bench");
}

constexpr const char* kExamples =
    "Examples:\n"
    "  paim-play character.paim\n"
    "      opens a window that plays the animation under the built-in sky\n"
    "  paim-play character.paim --env studio.exr --snapshot picture.png --pose 12 --camera 60,20\n"
    "      draws pose 12 under another light into a file\n"
    "  paim-play character.paim --frames-out clip --turn-camera 60 --camera-target pose\n"
    "      draws a clip, picture by picture, in which the camera follows and circles the body\n";

std::filesystem::path picture_path(const std::string& text) {
    std::filesystem::path path = text;
    if (path.extension() != ".png" && path.extension() != ".exr") {
        throw_usage("--snapshot: expected a file name that ends in .png or .exr, got '{}'", text);
    }
    return path;
}

void convert_picture(const RawOptions& raw, Options& options) {
    if (raw.environment) options.environment_path = *raw.environment;
    if (raw.snapshot) options.snapshot_path = picture_path(*raw.snapshot);
    if (raw.view) options.view_path = *raw.view;
    if (raw.save_view) options.save_view_path = *raw.save_view;
    if (raw.size) options.size = cli::parse_size(*raw.size, "--size");
    if (raw.camera) options.camera = parse_camera(*raw.camera);
    if (raw.target) options.target = parse_target(*raw.target);
    options.supersample = integer_in_range("--supersample", raw.supersample, 1, 8);
}

// Outputs replace no input and not each other.
void require_different_files(const Options& options) {
    const auto refuse_same = [](const char* option, const std::filesystem::path& output,
                                const std::optional<std::filesystem::path>& other,
                                const char* what) {
        if (!other) return;
        std::error_code ignored;
        const bool same = output.lexically_normal() == other->lexically_normal() ||
                          std::filesystem::equivalent(output, *other, ignored);
        if (same) throw_usage("{} {}: that is {}", option, output.string(), what);
    };
    const auto check = [&](const char* option, const std::optional<std::filesystem::path>& output) {
        if (!output) return;
        refuse_same(option, *output, options.model_path, "the model");
        refuse_same(option, *output, options.environment_path, "the light");
    };
    check("--snapshot", options.snapshot_path);
    check("--save-view", options.save_view_path);
    if (options.save_view_path) {
        refuse_same("--save-view", *options.save_view_path, options.snapshot_path,
                    "the file of --snapshot");
    }
}

void convert_clip(const RawOptions& raw, Options& options) {
    if (!raw.frames_out) {
        if (raw.fps || raw.seconds) throw_usage("--fps and --seconds need --frames-out");
        return;
    }
    if (raw.fps) require_range("--fps", *raw.fps, 0.01, 1000.0);
    if (raw.seconds) require_range("--seconds", *raw.seconds, 0.001, 1e5);
    options.clip = {*raw.frames_out, raw.fps, raw.seconds};
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

void require_one_mode(const Options& options) {
    const int num_modes = options.snapshot_path.has_value() + options.clip.has_value() +
                          options.bench_frames.has_value() + options.window_frames.has_value();
    if (num_modes > 1) {
        throw_usage("--snapshot, --frames-out, --bench and --frames exclude each other");
    }
    if (options.json && options.opens_window()) {
        throw_usage("--json needs --snapshot, --frames-out or --bench");
    }
    if (options.save_view_path && options.bench_frames) {
        throw_usage("--save-view and --bench exclude each other");
    }
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
    describe_files(app, raw, options);
    describe_picture(app, raw);
    const ViewOptions view(app);
    describe_detail(app, raw, options);
    describe_runs(app, raw, options);
    app.set_help_flag("-h,--help", "Print this help and quit");  // once more, to be listed last
    app.set_version_flag("--version", cli::version_text("paim-play"), "Print the version and quit");
    app.footer(
        keys_help() +
        "\nMouse: drag to turn the camera, drag with the right or middle button to move it, "
        "turn the wheel to come closer, click to pick a vertex. Drag with Ctrl to turn the "
        "light. Drop a .paim file onto the window to change the model, an .exr file to change "
        "the light.\n"
        "Exit codes: 0 ok, 1 usage, 2 bad input, 3 unsupported, 4 output failed.");
    if (const int code = cli::parse(app, argc, argv); code >= 0) return code;

    options.model_path = raw.model;
    convert_picture(raw, options);
    convert_clip(raw, options);
    convert_detail(raw, options);
    options.view_changes = view.changes();
    options.auto_exposure = view.auto_exposure();
    options.bench_frames = integer_in_range("--bench", raw.bench, 1, 100000);
    options.window_frames = integer_in_range("--frames", raw.frames, 1, kMaxCount);
    require_one_mode(options);
    require_different_files(options);
    return -1;
}

}  // namespace paim::player
