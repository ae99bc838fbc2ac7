// Small pieces that several panels are made of.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "player/gl/handle.h"

namespace paim::player {

constexpr float kPanelMargin = 10.0f;  // at ordinary density
constexpr float kPanelOpacity = 0.78f;

float panel_margin();

void text(const std::string& line);
void dim_text(const std::string& line);
// Wrapped after some 40 letters.
void text_in_lines(const std::string& line);
void note_text(const std::string& line);

// Opens a panel with its given corner (0 or 1 in x and y) at that place, screen coordinates. Ends with
// ImGui::End(), whatever this returns.
bool begin_panel(const char* name, const ImVec2& place, const ImVec2& corner,
                 ImGuiWindowFlags flags = 0, float opacity = kPanelOpacity);

// "1.25 MB"
std::string megabytes(uint64_t bytes);
// "0.52 %", with three digits that count; what is below 0.00001 % says so
std::string percent(double fraction);

// Sliders of doubles, which ImGui has for floats alone. Return whether the value has changed.
bool number_slider(const char* label, double& value, double lowest, double highest,
                   const char* format);
bool count_slider(const char* label, uint32_t& value, uint32_t lowest, uint32_t highest);

// A list of words to choose from. words(i) names choice i of `count`.
template <typename Words>
bool choice(const char* label, size_t& chosen, size_t count, const Words& words) {
    bool changed = false;
    if (!ImGui::BeginCombo(label, std::string(words(chosen)).c_str())) return false;
    for (size_t i = 0; i < count; ++i) {
        if (ImGui::Selectable(std::string(words(i)).c_str(), i == chosen)) {
            changed = i != chosen;
            chosen = i;
        }
    }
    ImGui::EndCombo();
    return changed;
}

// A texture as it was drawn by OpenGL (row 0 at the bottom), or uploaded (row 0 on top).
enum class Rows { bottom_up, top_down };
void picture(const gl::TextureHandle& texture, float size, Rows rows);

}  // namespace paim::player
