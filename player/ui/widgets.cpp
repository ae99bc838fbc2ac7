// Pieces of panels.
#include "player/ui/widgets.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace paim::player {

namespace {

constexpr ImGuiWindowFlags kPanelFlags =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;

}  // namespace

float panel_margin() {
    return kPanelMargin * ImGui::GetIO().FontGlobalScale;
}

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void dim_text(const std::string& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    text(line);
    ImGui::PopStyleColor();
}

void text_in_lines(const std::string& line) {
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + 20.0f * ImGui::GetFontSize());
    text(line);
    ImGui::PopTextWrapPos();
}

void note_text(const std::string& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    text_in_lines(line);
    ImGui::PopStyleColor();
}

bool begin_panel(const char* name, const ImVec2& place, const ImVec2& corner,
                 ImGuiWindowFlags flags, float opacity) {
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, corner);
    ImGui::SetNextWindowBgAlpha(opacity);
    return ImGui::Begin(name, nullptr, kPanelFlags | flags);
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.2f} MB", 1e-6 * static_cast<double>(bytes));
}

std::string percent(double fraction) {
    constexpr double kLeast = 1e-7;  // less is rounding
    if (fraction > 0.0 && fraction < kLeast) return "below 0.00001 %";
    return fmt::format("{:.3g} %", 100.0 * fraction);
}

bool number_slider(const char* label, double& value, double lowest, double highest,
                   const char* format) {
    return ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &lowest, &highest, format,
                               ImGuiSliderFlags_AlwaysClamp);
}

bool count_slider(const char* label, uint32_t& value, uint32_t lowest, uint32_t highest) {
    const std::string format = fmt::format("%u of {}", highest);
    return ImGui::SliderScalar(label, ImGuiDataType_U32, &value, &lowest, &highest, format.c_str(),
                               ImGuiSliderFlags_AlwaysClamp);
}

void picture(const gl::TextureHandle& texture, float size, Rows rows) {
    const bool top_down = rows == Rows::top_down;
    ImGui::Image(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture.id())),
                 ImVec2(size, size), ImVec2(0.0f, top_down ? 0.0f : 1.0f),
                 ImVec2(1.0f, top_down ? 1.0f : 0.0f));
}

}  // namespace paim::player
