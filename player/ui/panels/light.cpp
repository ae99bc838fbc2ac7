// The environment, its globe, and the key light.
#include <fmt/format.h>

#include <cmath>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

namespace {

void draw_globe(const PanelInfo& info, uint32_t bands) {
    if (info.globe_light == nullptr || info.globe_reconstruction == nullptr) return;
    const float size = 8.0f * ImGui::GetFontSize();
    ImGui::BeginGroup();
    picture(*info.globe_light, size, Rows::top_down);
    dim_text("the light");
    ImGui::EndGroup();
    ImGui::SameLine();
    ImGui::BeginGroup();
    picture(*info.globe_reconstruction, size, Rows::top_down);
    dim_text(fmt::format("its {} bands", bands));
    ImGui::EndGroup();
    if (info.negative_share > 0.0) {
        dim_text(fmt::format("below zero in {} of all directions", percent(info.negative_share)));
    }
}

void draw_key_light(LightView& light) {
    ImGui::Checkbox("key light", &light.key_on);
    if (!light.key_on) return;
    KeyLight& key = light.key;
    number_slider("azimuth", key.azimuth_deg, -180.0, 180.0, "%.0f deg");
    number_slider("elevation", key.elevation_deg, -90.0, 90.0, "%.0f deg");
    number_slider("size", key.angular_diameter_deg, KeyLight::kMinDiameter_deg,
                  KeyLight::kMaxDiameter_deg, "%.1f deg");
    number_slider("irradiance", key.strength, 0.0, 20.0, "%.2f");
    ImGui::ColorEdit3("colour", key.color.data(), ImGuiColorEditFlags_Float);
    // Any number can be typed; max() of no number is the other.
    const auto within = [](float x) {
        return std::fmin(std::fmax(x, 0.0f), static_cast<float>(kMaxStrength));
    };
    key.color = key.color.unaryExpr(within);
}

}  // namespace

void draw_light(const PanelInfo& info, ViewState& view) {
    LightView& light = view.light;
    dim_text(info.environment + "; Ctrl-drag turns it");
    draw_globe(info, view.limits.bands);
    LightOrientation shown = light.orientation.wrapped();
    const bool turned = number_slider("yaw", shown.yaw_deg, -180.0, 180.0, "%.0f deg") |
                        number_slider("pitch", shown.pitch_deg, -180.0, 180.0, "%.0f deg") |
                        number_slider("roll", shown.roll_deg, -180.0, 180.0, "%.0f deg");
    if (turned) light.orientation = shown;
    ImGui::Checkbox("turn by itself", &light.turning);
    if (light.turning) {
        number_slider("speed", light.turn_speed_deg, -90.0, 90.0, "%.0f deg/s");
    }
    number_slider("strength", light.strength, 0.0, 4.0, "%.2f");
    draw_key_light(light);
}

}  // namespace paim::player
