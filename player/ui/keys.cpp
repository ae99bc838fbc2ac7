// Keys to commands, commands to changes of the view.
#include "player/ui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "player/render/codec_words.h"

namespace paim::player {

namespace {

// What codecs call the components that vertices sum up themselves.
std::string vertex_components() {
    std::string names;
    for (const CodecWords& words : codec_words()) {
        names += fmt::format("{}{}", names.empty() ? "" : " or ", words.components);
    }
    return names;
}

const std::vector<KeyRow>& keys() {
    static const std::vector<KeyRow> rows = {
        KeyRow{"Space", "play or pause", {GLFW_KEY_SPACE, false, Command::play_pause}},
        KeyRow{"Left, Right",
               "one pose back, forth",
               {GLFW_KEY_LEFT, false, Command::previous_pose},
               {GLFW_KEY_RIGHT, false, Command::next_pose}},
        KeyRow{"Home, End",
               "first, last pose",
               {GLFW_KEY_HOME, false, Command::first_pose},
               {GLFW_KEY_END, false, Command::last_pose}},
        KeyRow{"[  ]",
               "fewer, more transfer components",
               {GLFW_KEY_LEFT_BRACKET, false, Command::fewer_transfer_components},
               {GLFW_KEY_RIGHT_BRACKET, false, Command::more_transfer_components}},
        KeyRow{"Shift+[  ]",
               "fewer, more " + vertex_components(),
               {GLFW_KEY_LEFT_BRACKET, true, Command::fewer_vertex_components},
               {GLFW_KEY_RIGHT_BRACKET, true, Command::more_vertex_components}},
        KeyRow{";  '",
               "fewer, more geometry components",
               {GLFW_KEY_SEMICOLON, false, Command::fewer_geometry_components},
               {GLFW_KEY_APOSTROPHE, false, Command::more_geometry_components}},
        KeyRow{"Shift+B, B",
               "fewer, more bands",
               {GLFW_KEY_B, true, Command::fewer_bands},
               {GLFW_KEY_B, false, Command::more_bands}},
        KeyRow{"Shift+E, E",
               "exposure down, up by 1/4 stop",
               {GLFW_KEY_E, true, Command::lower_exposure},
               {GLFW_KEY_E, false, Command::raise_exposure}},
        KeyRow{"Shift+G, G",
               "gamma down, up; below 1 is sRGB",
               {GLFW_KEY_G, true, Command::lower_gamma},
               {GLFW_KEY_G, false, Command::raise_gamma}},
        KeyRow{",  .",
               "turn the light by 5 degrees",
               {GLFW_KEY_COMMA, false, Command::turn_light_clockwise},
               {GLFW_KEY_PERIOD, false, Command::turn_light_counter_clockwise}},
        KeyRow{"L", "keep the light turning", {GLFW_KEY_L, false, Command::auto_turn}},
        KeyRow{"K",
               "next background: environment, black, grey, white",
               {GLFW_KEY_K, false, Command::next_background}},
        KeyRow{"F", "show the whole animation", {GLFW_KEY_F, false, Command::frame_all}},
        KeyRow{"S", "save the view as a PNG file", {GLFW_KEY_S, false, Command::snapshot}},
        KeyRow{"Tab", "hide or show the panels", {GLFW_KEY_TAB, false, Command::toggle_panel}},
        KeyRow{"H", "hide or show this help", {GLFW_KEY_H, false, Command::toggle_help}},
        KeyRow{"Esc", "quit", {GLFW_KEY_ESCAPE, false, Command::quit}},
    };
    return rows;
}

constexpr float kExposureStep = 0.25f;
constexpr float kGammaStep = 0.2f;
constexpr double kTurnStepDegrees = 5.0;

uint32_t fewer(uint32_t value, uint32_t lowest) {
    return value > lowest ? value - 1 : lowest;
}

uint32_t more(uint32_t value, uint32_t highest) {
    return value < highest ? value + 1 : highest;
}

// A whole pose `step` away from the one shown, round the ends.
void step_pose(ViewState& view, const ViewRange& range, int step) {
    const auto num_poses = static_cast<double>(range.num_poses);
    const double pose = std::min(view.time, num_poses - 1.0);
    const double next = step < 0 ? std::ceil(pose) - 1.0 : std::floor(pose) + 1.0;
    view.time = next < 0.0 ? num_poses - 1.0 : next >= num_poses ? 0.0 : next;
    view.playing = false;
}

void show_pose(ViewState& view, double pose) {
    view.time = pose;
    view.playing = false;
}

// 0 (sRGB), 1, 1.2, … 5.
void change_gamma(ViewState& view, float step) {
    float& gamma = view.tone_curve.gamma;
    if (gamma == 0.0f) {
        gamma = step > 0.0f ? 1.0f : 0.0f;
        return;
    }
    gamma = std::round((gamma + step) * 10.0f) / 10.0f;
    if (gamma < 1.0f) gamma = 0.0f;
    gamma = std::min(gamma, 5.0f);
}

void next_background(Background& background) {
    if (background.kind == Background::Kind::environment) {
        background = {Background::Kind::color, Vec3f::Zero()};
    } else if (background.color == Vec3f::Zero()) {
        background.color = Vec3f::Constant(0.2f);
    } else if (background.color != Vec3f::Ones()) {
        background.color = Vec3f::Ones();
    } else {
        background = {};
    }
}

// The following carry out some of the commands each, and return whether this was one of them.

bool change_pose(Command command, ViewState& view, const ViewRange& range) {
    switch (command) {
        case Command::play_pause:
            view.playing = !view.playing;
            return true;
        case Command::previous_pose:
            step_pose(view, range, -1);
            return true;
        case Command::next_pose:
            step_pose(view, range, 1);
            return true;
        case Command::first_pose:
            show_pose(view, 0.0);
            return true;
        case Command::last_pose:
            show_pose(view, static_cast<double>(range.num_poses) - 1.0);
            return true;
        default:
            return false;
    }
}

bool change_limits(Command command, DecodeLimits& limits, const ViewRange& range) {
    switch (command) {
        case Command::fewer_transfer_components:
            limits.transfer_components = fewer(limits.transfer_components, 0);
            return true;
        case Command::more_transfer_components:
            limits.transfer_components =
                more(limits.transfer_components, range.transfer_components);
            return true;
        case Command::fewer_vertex_components:
            limits.vertex_components = fewer(limits.vertex_components, 0);
            return true;
        case Command::more_vertex_components:
            limits.vertex_components = more(limits.vertex_components, range.vertex_components);
            return true;
        case Command::fewer_geometry_components:
            limits.geometry_components = fewer(limits.geometry_components, 0);
            return true;
        case Command::more_geometry_components:
            limits.geometry_components =
                more(limits.geometry_components, range.geometry_components);
            return true;
        case Command::fewer_bands:
            limits.bands = fewer(limits.bands, 1);
            return true;
        case Command::more_bands:
            limits.bands = more(limits.bands, range.bands);
            return true;
        default:
            return false;
    }
}

void turn_light(ViewState& view, double degrees) {
    view.env_rotation_deg = std::remainder(view.env_rotation_deg + degrees, 360.0);
}

bool change_display(Command command, ViewState& view) {
    switch (command) {
        case Command::lower_exposure:
            view.tone_curve.exposure_ev -= kExposureStep;
            return true;
        case Command::raise_exposure:
            view.tone_curve.exposure_ev += kExposureStep;
            return true;
        case Command::lower_gamma:
            change_gamma(view, -kGammaStep);
            return true;
        case Command::raise_gamma:
            change_gamma(view, kGammaStep);
            return true;
        case Command::turn_light_clockwise:
            turn_light(view, -kTurnStepDegrees);
            return true;
        case Command::turn_light_counter_clockwise:
            turn_light(view, kTurnStepDegrees);
            return true;
        case Command::auto_turn:
            view.turning = !view.turning;
            return true;
        case Command::next_background:
            next_background(view.background);
            return true;
        case Command::toggle_panel:
            view.show_panel = !view.show_panel;
            return true;
        case Command::toggle_help:
            view.show_help = !view.show_help;
            return true;
        default:
            return false;
    }
}

}  // namespace

std::span<const KeyRow> key_table() {
    return keys();
}

std::string keys_help() {
    std::string text = "Keys in the window:\n";
    for (const KeyRow& row : keys()) text += fmt::format("  {:<12}  {}\n", row.keys, row.meaning);
    return text;
}

Command command_of_key(int glfw_key, bool shift) {
    for (const KeyRow& row : keys()) {
        for (const KeyBinding& binding : {row.first, row.second}) {
            if (binding.command == Command::none) continue;
            if (binding.glfw_key == glfw_key && binding.shift == shift) return binding.command;
        }
    }
    return Command::none;
}

void apply(Command command, ViewState& view, const ViewRange& range) {
    if (change_pose(command, view, range)) return;
    if (change_limits(command, view.limits, range)) return;
    change_display(command, view);
}

}  // namespace paim::player
