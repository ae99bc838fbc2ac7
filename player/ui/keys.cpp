// Keys and what they do.
#include "player/ui/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "player/light/auto_exposure.h"
#include "player/render/codec_words.h"

namespace paim::player {

namespace {

constexpr float kExposureStep = 0.25f;
constexpr float kGammaStep = 0.2f;
constexpr double kTurnStep_deg = 5.0;

// What codecs call the components that vertices sum up themselves.
std::string vertex_components() {
    std::string names;
    for (const CodecWords& words : codec_words()) {
        names += fmt::format("{}{}", names.empty() ? "" : " or ", words.components);
    }
    return names;
}

template <uint32_t DecodeLimits::*kLimit, int kStep>
void change_limit(ViewState& view, const ViewRange& range) {
    constexpr uint32_t kLowest = kLimit == &DecodeLimits::bands ? 1 : 0;
    const int64_t changed = int64_t{view.limits.*kLimit} + kStep;
    view.limits.*kLimit = static_cast<uint32_t>(
        std::clamp<int64_t>(changed, kLowest, std::max(kLowest, range.limits.*kLimit)));
}

template <int kStep>
void change_gamma(ViewState& view, const ViewRange&) {
    // 0 (sRGB), 1, 1.2, … 5.
    float& gamma = view.tone_curve.gamma;
    if (gamma == 0.0f) {
        gamma = kStep > 0 ? 1.0f : 0.0f;
        return;
    }
    gamma = std::round((gamma + kStep * kGammaStep) * 10.0f) / 10.0f;
    if (gamma < 1.0f) gamma = 0.0f;
    gamma = std::min(gamma, 5.0f);
}

template <int kSteps>
void change_exposure(ViewState& view, const ViewRange&) {
    float& exposure_ev = view.tone_curve.exposure_ev;
    exposure_ev =
        std::clamp(exposure_ev + kSteps * kExposureStep, -kLargestExposure_ev, kLargestExposure_ev);
}

void next_tone_operator(ViewState& view, const ViewRange&) {
    const auto names = tone_operator_names();
    const auto at = std::find_if(names.begin(), names.end(), [&](const auto& name) {
        return name.second == view.tone_curve.tone_operator;
    });
    view.tone_curve.tone_operator = (at + 1 == names.end() ? names.begin() : at + 1)->second;
}

template <int kSteps>
void turn_light(ViewState& view, const ViewRange&) {
    double& yaw_deg = view.light.orientation.yaw_deg;
    yaw_deg = std::remainder(yaw_deg + kSteps * kTurnStep_deg, 360.0);
}

// Environment, blurred, black, grey, white.
void next_background(ViewState& view, const ViewRange&) {
    using enum Background::Kind;
    Background& background = view.background;
    if (background.kind == environment) {
        background.kind = blurred;
    } else if (background.kind == blurred) {
        background = {color, Vec3f::Zero()};
    } else if (background.color == Vec3f::Zero()) {
        background.color = Vec3f::Constant(0.2f);
    } else if (background.color != Vec3f::Ones()) {
        background.color = Vec3f::Ones();
    } else {
        background = {};
    }
}

template <int kStep>
void next_surface(ViewState& view, const ViewRange&) {
    const auto count = static_cast<int>(surface_views().size());
    view.surface =
        static_cast<SurfaceView>((static_cast<int>(view.surface) + kStep + count) % count);
}

template <int kStep>
void next_coefficient(ViewState& view, const ViewRange& range) {
    const auto count = static_cast<int>(range.limits.bands * range.limits.bands);
    view.surface = SurfaceView::coefficient;
    view.coefficient =
        static_cast<uint32_t>((static_cast<int>(view.coefficient) + kStep + count) % count);
}

void next_comparison(ViewState& view, const ViewRange&) {
    using enum Comparison;
    view.comparison = view.comparison == none   ? wipe
                      : view.comparison == wipe ? side_by_side
                                                : none;
}

void next_crowd(ViewState& view, const ViewRange&) {
    constexpr uint32_t kCrowds[] = {1, 9, 25, 100};
    const auto* const next =
        std::upper_bound(std::begin(kCrowds), std::end(kCrowds), view.num_instances);
    view.num_instances = next == std::end(kCrowds) ? 1 : *next;
}

// Half or twice as fast, from 1/4 to 4 times, in the same direction.
template <int kStep>
void change_speed(ViewState& view, const ViewRange&) {
    constexpr double kSlowest = 0.25;
    double& speed = view.animation.speed;
    const double now = std::abs(speed);
    const double next = kStep > 0 ? std::clamp(2.0 * now, kSlowest, kMaxSpeed)
                                  : std::max(0.5 * now, std::min(now, kSlowest));
    speed = std::copysign(next, speed);
}

using Limits = DecodeLimits;

KeyGroup animation_keys() {
    return {"Animation",
            {{"Space",
              "play or pause",
              {{GLFW_KEY_SPACE, false,
                [](ViewState& view, const ViewRange&) {
                    view.animation.playing = !view.animation.playing;
                }}}},
             {"Left, Right",
              "one pose back, forward",
              {{GLFW_KEY_LEFT, false,
                [](ViewState& view, const ViewRange& range) {
                    step_pose(view.animation, range.num_poses, -1);
                }},
               {GLFW_KEY_RIGHT, false,
                [](ViewState& view, const ViewRange& range) {
                    step_pose(view.animation, range.num_poses, 1);
                }}}},
             {"Home, End",
              "first, last pose",
              {{GLFW_KEY_HOME, false,
                [](ViewState& view, const ViewRange&) { show_pose(view.animation, 0.0); }},
               {GLFW_KEY_END, false,
                [](ViewState& view, const ViewRange& range) {
                    show_pose(view.animation, static_cast<double>(range.num_poses) - 1.0);
                }}}},
             {"Down, Up",
              "slower, faster",
              {{GLFW_KEY_DOWN, false, change_speed<-1>}, {GLFW_KEY_UP, false, change_speed<1>}}},
             {"R",
              "play backwards or forwards",
              {{GLFW_KEY_R, false,
                [](ViewState& view, const ViewRange&) {
                    view.animation.speed = -view.animation.speed;
                }}}},
             {"P",
              "there and back, or from the start again",
              {{GLFW_KEY_P, false,
                [](ViewState& view, const ViewRange&) {
                    view.animation.ping_pong = !view.animation.ping_pong;
                }}}},
             {"I",
              "smooth in-betweens, or whole poses alone",
              {{GLFW_KEY_I, false, [](ViewState& view, const ViewRange&) {
                    view.animation.in_betweens = !view.animation.in_betweens;
                }}}}}};
}

KeyGroup accuracy_keys() {
    return {"Accuracy",
            {{"[  ]",
              "fewer, more transfer components",
              {{GLFW_KEY_LEFT_BRACKET, false, change_limit<&Limits::transfer_components, -1>},
               {GLFW_KEY_RIGHT_BRACKET, false, change_limit<&Limits::transfer_components, 1>}}},
             {"Shift+[  ]",
              "fewer, more " + vertex_components(),
              {{GLFW_KEY_LEFT_BRACKET, true, change_limit<&Limits::vertex_components, -1>},
               {GLFW_KEY_RIGHT_BRACKET, true, change_limit<&Limits::vertex_components, 1>}}},
             {";  '",
              "fewer, more geometry components",
              {{GLFW_KEY_SEMICOLON, false, change_limit<&Limits::geometry_components, -1>},
               {GLFW_KEY_APOSTROPHE, false, change_limit<&Limits::geometry_components, 1>}}},
             {"Shift+B, B",
              "fewer, more bands",
              {{GLFW_KEY_B, true, change_limit<&Limits::bands, -1>},
               {GLFW_KEY_B, false, change_limit<&Limits::bands, 1>}}},
             {"X",
              "compare with the whole file: wipe, side by side, not at all",
              {{GLFW_KEY_X, false, next_comparison}}}}};
}

KeyGroup picture_keys() {
    return {
        "Light and picture",
        {{",  .",
          "turn the light by 5 degrees",
          {{GLFW_KEY_COMMA, false, turn_light<-1>}, {GLFW_KEY_PERIOD, false, turn_light<1>}}},
         {"L",
          "keep the light turning",
          {{GLFW_KEY_L, false,
            [](ViewState& view, const ViewRange&) { view.light.turning = !view.light.turning; }}}},
         {"N",
          "key light on or off",
          {{GLFW_KEY_N, false,
            [](ViewState& view, const ViewRange&) { view.light.key_on = !view.light.key_on; }}}},
         {"Shift+E, E",
          "exposure down, up by 1/4 stop",
          {{GLFW_KEY_E, true, change_exposure<-1>}, {GLFW_KEY_E, false, change_exposure<1>}}},
         {"A",
          "the exposure that suits what is lit",
          {{GLFW_KEY_A, false, nullptr, WindowCommand::auto_exposure}}},
         {"M", "next tone map", {{GLFW_KEY_M, false, next_tone_operator}}},
         {"Shift+G, G",
          "gamma down, up; below 1 is sRGB",
          {{GLFW_KEY_G, true, change_gamma<-1>}, {GLFW_KEY_G, false, change_gamma<1>}}},
         {"K",
          "next background: environment, blurred, black, grey, white",
          {{GLFW_KEY_K, false, next_background}}},
         {"Shift+V, V",
          "previous, next view of the surface",
          {{GLFW_KEY_V, true, next_surface<-1>}, {GLFW_KEY_V, false, next_surface<1>}}},
         {"Shift+C, C",
          "previous, next coefficient of the transfer",
          {{GLFW_KEY_C, true, next_coefficient<-1>}, {GLFW_KEY_C, false, next_coefficient<1>}}},
         {"W",
          "edges of the triangles",
          {{GLFW_KEY_W, false,
            [](ViewState& view, const ViewRange&) { view.edges = !view.edges; }}}},
         {"Y", "a crowd: 1, 9, 25 or 100 copies", {{GLFW_KEY_Y, false, next_crowd}}}}};
}

KeyGroup window_keys() {
    using enum WindowCommand;
    return {
        "Camera and window",
        {{"F, Shift+F",
          "show all poses, or this pose",
          {{GLFW_KEY_F, false, nullptr, frame_all}, {GLFW_KEY_F, true, nullptr, frame_pose}}},
         {"T",
          "the camera follows the body, or stays",
          {{GLFW_KEY_T, false, nullptr, follow_body}}},
         {"S, Shift+S",
          "save the picture as a PNG, OpenEXR file",
          {{GLFW_KEY_S, false, nullptr, snapshot_png}, {GLFW_KEY_S, true, nullptr, snapshot_exr}}},
         {"D", "save the view as a JSON file", {{GLFW_KEY_D, false, nullptr, save_view}}},
         {"O", "open a model or a light", {{GLFW_KEY_O, false, nullptr, open_file}}},
         {"F9", "record a clip as PNG files, or stop", {{GLFW_KEY_F9, false, nullptr, record}}},
         {"F11", "full screen", {{GLFW_KEY_F11, false, nullptr, full_screen}}},
         {"Tab", "hide or show the panels", {{GLFW_KEY_TAB, false, nullptr, toggle_panels}}},
         {"H", "hide or show this help", {{GLFW_KEY_H, false, nullptr, toggle_help}}},
         {"Esc", "quit", {{GLFW_KEY_ESCAPE, false, nullptr, quit}}}}};
}

}  // namespace

std::span<const KeyGroup> key_groups() {
    static const std::vector<KeyGroup> groups = [] {
        std::vector<KeyGroup> all = {animation_keys(), accuracy_keys(), picture_keys(),
                                     window_keys()};
        // Two keys of a row step down and up.
        for (KeyGroup& group : all) {
            for (KeyRow& row : group.rows) {
                for (KeyBinding& binding : row.bindings) {
                    binding.repeats = row.bindings.size() == 2 && binding.change != nullptr;
                }
            }
        }
        return all;
    }();
    return groups;
}

std::string keys_help() {
    std::string text = "Keys in the window:\n";
    for (const KeyGroup& group : key_groups()) {
        for (const KeyRow& row : group.rows) {
            text += fmt::format("  {:<12}  {}\n", row.keys, row.meaning);
        }
    }
    return text;
}

const KeyBinding* find_key(int glfw_key, bool shift) {
    for (const KeyGroup& group : key_groups()) {
        for (const KeyRow& row : group.rows) {
            for (const KeyBinding& binding : row.bindings) {
                if (binding.glfw_key == glfw_key && binding.shift == shift) return &binding;
            }
        }
    }
    return nullptr;
}

}  // namespace paim::player
