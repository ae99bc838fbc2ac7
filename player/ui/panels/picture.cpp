// How the picture is displayed.
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

void choose_background(Background& background) {
    const auto all = backgrounds();
    size_t chosen = 0;
    while (chosen + 1 < all.size() && (all[chosen].background.kind != background.kind ||
                                       (background.kind == Background::Kind::color &&
                                        all[chosen].background.color != background.color))) {
        ++chosen;
    }
    if (choice("background", chosen, all.size(), [&](size_t i) { return all[i].name; })) {
        background = all[chosen].background;
    }
}

}  // namespace

void draw_picture(ViewState& view, PanelRequests& requests) {
    ToneCurve& curve = view.tone_curve;
    ImGui::SliderFloat("exposure", &curve.exposure_ev, -8.0f, 8.0f, "%.2f EV");
    ImGui::SameLine();
    if (ImGui::SmallButton("auto")) requests.commands.push_back(WindowCommand::auto_exposure);
    const auto names = tone_operator_names();
    size_t chosen = 0;
    while (names[chosen].second != curve.tone_operator) ++chosen;
    if (choice("tone map", chosen, names.size(), [&](size_t i) { return names[i].first; })) {
        curve.tone_operator = names[chosen].second;
    }
    ImGui::SliderFloat("gamma", &curve.gamma, 0.0f, 5.0f, curve.gamma == 0.0f ? "sRGB" : "%.1f",
                       ImGuiSliderFlags_AlwaysClamp);
    // Below 1 a curve is of no use; the low end of the slider means sRGB.
    if (curve.gamma < 1.0f) curve.gamma = 0.0f;
    choose_background(view.background);
}

}  // namespace paim::player
