// How the picture is displayed.
#include <algorithm>

#include "player/light/auto_exposure.h"
#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

namespace {

struct NamedBackground {
    const char* name;
    Background background;
};

std::span<const NamedBackground> backgrounds() {
    using enum Background::Kind;
    static const NamedBackground all[] = {{"environment", {environment, Vec3f::Zero()}},
                                          {"blurred", {blurred, Vec3f::Zero()}},
                                          {"black", {color, Vec3f::Zero()}},
                                          {"grey", {color, Vec3f::Constant(0.2f)}},
                                          {"white", {color, Vec3f::Ones()}}};
    return all;
}

// The colour counts where it is shown.
bool is_same(const Background& a, const Background& b) {
    return a.kind == b.kind && (a.kind != Background::Kind::color || a.color == b.color);
}

void choose_background(Background& background) {
    const auto all = backgrounds();
    size_t chosen = 0;
    while (chosen < all.size() && !is_same(all[chosen].background, background)) ++chosen;
    if (choice("background", chosen, all.size(),
               [&](size_t i) { return i < all.size() ? all[i].name : "a colour"; })) {
        background = all[chosen].background;
    }
}

}  // namespace

void draw_picture(ViewState& view, PanelRequests& requests) {
    ToneCurve& curve = view.tone_curve;
    // Others can be typed.
    ImGui::SliderFloat("exposure", &curve.exposure_ev, -8.0f, 8.0f, "%.2f EV");
    curve.exposure_ev = std::clamp(curve.exposure_ev, -kLargestExposure_ev, kLargestExposure_ev);
    ImGui::SameLine();
    if (ImGui::SmallButton("auto")) requests.commands.push_back(WindowCommand::auto_exposure);
    const auto names = tone_operator_names();
    size_t chosen = 0;
    while (names[chosen].second != curve.tone_operator) ++chosen;
    if (choice("tone map", chosen, names.size(), [&](size_t i) { return names[i].first; })) {
        curve.tone_operator = names[chosen].second;
    }
    // Below 1 a curve is of little use; the low end of the slider means sRGB.
    if (ImGui::SliderFloat("gamma", &curve.gamma, 0.0f, 5.0f, curve.gamma == 0.0f ? "sRGB" : "%.1f",
                           ImGuiSliderFlags_AlwaysClamp) &&
        curve.gamma < 1.0f) {
        curve.gamma = 0.0f;
    }
    choose_background(view.background);
}

}  // namespace paim::player
