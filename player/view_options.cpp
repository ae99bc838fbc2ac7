// Options of light, picture, surface and animation: one description each, with unit, range and default.
#include "player/view_options.h"

#include <charconv>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include "player/light/auto_exposure.h"
#include "player/option_group.h"
#include "player/view/view_fields.h"

namespace paim::player {

// As typed; checked and converted afterwards. An option that is not given holds nothing.
struct ViewOptions::Raw {
    std::optional<std::string> background, exposure, key_light, surface, compare, tone_map, gloss;
    std::optional<double> pose, speed, env_rotation, env_pitch, env_roll, env_strength, turn_light,
        turn_camera, gamma, coefficient, split, instances;
    bool ping_pong = false, whole_poses = false, no_textures = false, edges = false;
};

namespace {

constexpr int kMaxPose = 1000000000;

Background parse_background(const std::string& text) {
    if (text == "env") return {};
    if (text == "blurred") return {Background::Kind::blurred, Vec3f::Zero()};
    if (text == "black") return {Background::Kind::color, Vec3f::Zero()};
    return {Background::Kind::color,
            cli::parse_color(text, "--background (env, blurred, black or R,G,B)")};
}

KeyLight parse_key_light(const std::string& text) {
    KeyLight key;
    std::vector<double> values =
        parse_numbers("--key-light", text, 2, 4, "AZIMUTH,ELEVATION[,DIAMETER[,STRENGTH]]");
    if (values.size() < 3) values.push_back(key.angular_diameter_deg);
    if (values.size() < 4) values.push_back(key.strength);
    require_range("--key-light azimuth", values[0], -360.0, 360.0);
    require_range("--key-light elevation", values[1], -90.0, 90.0);
    require_range("--key-light diameter", values[2], KeyLight::kMinDiameter_deg,
                  KeyLight::kMaxDiameter_deg);
    require_range("--key-light strength", values[3], 0.0, kMaxStrength);
    key.azimuth_deg = values[0];
    key.elevation_deg = values[1];
    key.angular_diameter_deg = values[2];
    key.strength = values[3];
    return key;
}

template <typename Value>
Value parse_word(const char* option, const std::string& text, const Names<Value>& names) {
    std::string expected;
    for (const auto& [word, value] : names) {
        if (word == text) return value;
        expected += (expected.empty() ? "" : ", ") + word;
    }
    throw_usage("{}: expected one of {}, got '{}'", option, expected, text);
}

float parse_exposure(const std::string& text) {
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [rest, failure] = std::from_chars(text.data(), end, value);
    if (failure != std::errc() || rest != end) {
        throw_usage("--exposure: expected a number or auto, got '{}'", text);
    }
    require_range("--exposure", value, -double{kLargestExposure_ev}, double{kLargestExposure_ev});
    return static_cast<float>(value);
}

}  // namespace

ViewOptions::ViewOptions(CLI::App& app) : raw_(std::make_unique<Raw>()) {
    OptionGroup animation(app, "Animation");
    animation.add("--pose", raw_->pose, "P",
                  "Pose to show, or to start playing from: 0 is the first, a fraction lies between "
                  "two poses (default: 0)");
    animation.add("--speed", raw_->speed, "S",
                  "How fast the animation plays, -4 to 4 times the rate of the file (default: 1)");
    animation.add_flag("--ping-pong", raw_->ping_pong,
                       "Play there and back, instead of starting again after the last pose");
    animation.add_flag("--whole-poses", raw_->whole_poses,
                       "Show the poses of the file alone, without the moments between them");
    animation.add("--instances", raw_->instances, "N",
                  "A crowd of N copies on a grid, 1 to 10000, each at another moment (default: 1)");

    OptionGroup light(app, "Light");
    light.add("--env-rotation", raw_->env_rotation, "DEG",
              "Angle by which light and background are turned about +Y, in degrees, -36000 to "
              "36000, counter-clockwise seen from above (default: 0)");
    light.add("--env-pitch", raw_->env_pitch, "DEG",
              "Then about the environment's own +X, -36000 to 36000 (default: 0)");
    light.add("--env-roll", raw_->env_roll, "DEG",
              "Then about the environment's own +Z, -36000 to 36000 (default: 0)");
    light.add("--env-strength", raw_->env_strength, "F",
              "Factor of the environment's radiance, 0 to 1000000 (default: 1)");
    light.add("--turn-light", raw_->turn_light, "DEG",
              "Degrees a second by which the environment turns about +Y in the window and in "
              "clips, -360 to 360; 0: it stays (default: 12)");
    light.add("--key-light", raw_->key_light, "AZ,EL[,D[,S]]",
              "A second light, a disc at azimuth AZ and elevation EL as for --camera, D degrees "
              "wide (0.5 to 180, default 10), of irradiance S (default 1)");

    OptionGroup picture(app, "Picture");
    picture.add("--background", raw_->background, "env|blurred|black|R,G,B",
                "Background: the environment, sharp or blurred, black, or a colour of linear "
                "radiance, each channel 0 to 1 (default: env)");
    picture.add("--exposure", raw_->exposure, "EV|auto",
                "Multiply radiance by 2^EV before it is displayed, -30 to 30 stops, or what suits "
                "the surface; for PNG files and the window, OpenEXR files keep linear radiance "
                "(default: 0)");
    picture.add(
        "--tone-map", raw_->tone_map, "clamp|reinhard|aces",
        "How bright radiance becomes white: cut off, compressed (Reinhard), or the film-like "
        "curve of ACES; for PNG files and the window (default: clamp)");
    picture.add("--gamma", raw_->gamma, "G",
                "Display curve x^(1/G), 0.1 to 10, or 0 for the sRGB curve; for PNG files and the "
                "window (default: 0)");
    picture.add("--turn-camera", raw_->turn_camera, "DEG",
                "Degrees a second by which the camera circles in the window and in clips, -360 to "
                "360 (default: 0)");

    OptionGroup surface(app, "Surface");
    std::string names;
    for (const SurfaceViewRow& row : surface_views()) {
        names += (names.empty() ? "" : "|") + std::string(row.name);
    }
    surface.add("--surface", raw_->surface, names.c_str(),
                "What the surface shows: its light, or colours for a coefficient of the transfer, "
                "normals, shape, albedo, groups of vertices, the open part of the sky, or what "
                "fewer components and bands lose (default: lit)");
    surface.add("--coefficient", raw_->coefficient, "I",
                "The coefficient of --surface coefficient, I = l (l + 1) + m for band l and order "
                "m, 0 to 4095 (default: 0)");
    surface.add("--gloss", raw_->gloss, "pixel|vertex|off",
                "Where gloss is computed: at each pixel, at each vertex, which is faster and blurs "
                "narrow highlights, or not at all (default: pixel)");
    surface.add_flag("--no-textures", raw_->no_textures,
                     "Show the albedo of the vertices where faces have images");
    surface.add_flag("--edges", raw_->edges, "Draw the edges of the triangles, too");
    surface.add("--compare", raw_->compare, "none|wipe|side-by-side",
                "Show the whole file, too: to the right of --split, or in the right half (default: "
                "none)");
    surface.add("--split", raw_->split, "F",
                "Where --compare wipe divides the picture, 0 (left) to 1 (right) (default: 0.5)");
}

ViewOptions::~ViewOptions() = default;

bool ViewOptions::auto_exposure() const {
    return raw_->exposure == "auto";
}

ViewChanges ViewOptions::changes() const {
    ViewChanges changes;
    const auto number = [&](const char* option, const std::optional<double>& value, double lowest,
                            double highest, void (*set)(ViewState&, double)) {
        if (!value) return;
        require_range(option, *value, lowest, highest);
        changes.emplace_back([set, value = *value](ViewState& view) { set(view, value); });
    };
    const auto flag = [&](bool given, void (*set)(ViewState&)) {
        if (given) changes.emplace_back(set);
    };
    // Whatever is parsed from a text.
    const auto value = [&](const std::optional<std::string>& text, auto parse, auto set) {
        if (!text) return;
        changes.emplace_back([set, parsed = parse(*text)](ViewState& view) { set(view, parsed); });
    };
    const Raw& raw = *raw_;
    using View = ViewState;
    number("--pose", raw.pose, 0.0, kMaxPose, [](View& v, double x) { v.animation.time = x; });
    number("--speed", raw.speed, -kMaxSpeed, kMaxSpeed,
           [](View& v, double x) { v.animation.speed = x; });
    flag(raw.ping_pong, [](View& v) { v.animation.ping_pong = true; });
    flag(raw.whole_poses, [](View& v) { v.animation.in_betweens = false; });
    number("--env-rotation", raw.env_rotation, -kMaxAngle_deg, kMaxAngle_deg,
           [](View& v, double x) { v.light.orientation.yaw_deg = x; });
    number("--env-pitch", raw.env_pitch, -kMaxAngle_deg, kMaxAngle_deg,
           [](View& v, double x) { v.light.orientation.pitch_deg = x; });
    number("--env-roll", raw.env_roll, -kMaxAngle_deg, kMaxAngle_deg,
           [](View& v, double x) { v.light.orientation.roll_deg = x; });
    number("--env-strength", raw.env_strength, 0.0, kMaxStrength,
           [](View& v, double x) { v.light.strength = x; });
    number("--turn-light", raw.turn_light, -kMaxTurnSpeed_deg, kMaxTurnSpeed_deg,
           [](View& v, double x) {
               v.light.turn_speed_deg = x;
               v.light.turning = x != 0.0;
           });
    number("--turn-camera", raw.turn_camera, -kMaxTurnSpeed_deg, kMaxTurnSpeed_deg,
           [](View& v, double x) { v.camera.turn_speed_deg = x; });
    number("--split", raw.split, 0.0, 1.0, [](View& v, double x) { v.split = x; });
    if (raw.gamma && *raw.gamma != 0.0)
        require_range("--gamma (or 0)", *raw.gamma, 0.1, double{kHighestGamma});
    number("--gamma", raw.gamma, 0.0, double{kHighestGamma},
           [](View& v, double x) { v.tone_curve.gamma = static_cast<float>(x); });
    value(raw.background, parse_background,
          [](View& v, const Background& background) { v.background = background; });
    value(raw.key_light, parse_key_light, [](View& v, const KeyLight& key) {
        v.light.key = key;
        v.light.key_on = true;
    });
    value(
        raw.tone_map, [](const std::string& text) { return parse_tone_operator(text); },
        [](View& v, ToneOperator chosen) { v.tone_curve.tone_operator = chosen; });
    value(
        raw.surface, [](const std::string& text) { return parse_surface_view(text); },
        [](View& v, SurfaceView surface) { v.surface = surface; });
    value(
        raw.compare,
        [](const std::string& text) { return parse_word("--compare", text, comparison_names()); },
        [](View& v, Comparison comparison) { v.comparison = comparison; });
    value(
        raw.gloss,
        [](const std::string& text) { return parse_word("--gloss", text, gloss_detail_names()); },
        [](View& v, GlossDetail gloss) { v.gloss = gloss; });
    if (!auto_exposure()) {
        value(raw.exposure, parse_exposure,
              [](View& v, float exposure_ev) { v.tone_curve.exposure_ev = exposure_ev; });
    }
    if (const auto i = integer_in_range("--coefficient", raw.coefficient, 0,
                                        static_cast<int>(kMaxCoefficient))) {
        changes.emplace_back([i](View& v) { v.coefficient = static_cast<uint32_t>(*i); });
    }
    if (const auto n =
            integer_in_range("--instances", raw.instances, 1, static_cast<int>(kMostInstances))) {
        changes.emplace_back([n](View& v) { v.num_instances = static_cast<uint32_t>(*n); });
    }
    flag(raw.no_textures, [](View& v) { v.textures = false; });
    flag(raw.edges, [](View& v) { v.edges = true; });
    return changes;
}

}  // namespace paim::player
