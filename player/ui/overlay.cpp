// Panels.
#include "player/ui/overlay.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "player/ui/keys.h"

namespace paim::player {

namespace {

constexpr ImGuiWindowFlags kPanelFlags =
    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove |
    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
constexpr float kMargin = 12.0f;
constexpr float kOpacity = 0.72f;

void text(const std::string& line) {
    ImGui::TextUnformatted(line.c_str());
}

void dim_text(const std::string& line) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    text(line);
    ImGui::PopStyleColor();
}

// Opens a panel with its given corner (0 or 1 in x and y) at that corner of the window.
bool begin_panel(const char* name, float corner_x, float corner_y) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 at(corner_x == 0.0f ? kMargin : size.x - kMargin,
                    corner_y == 0.0f ? kMargin : size.y - kMargin);
    ImGui::SetNextWindowPos(at, ImGuiCond_Always, ImVec2(corner_x, corner_y));
    ImGui::SetNextWindowBgAlpha(kOpacity);
    return ImGui::Begin(name, nullptr, kPanelFlags);
}

void count_slider(const char* label, uint32_t& value, uint32_t lowest, uint32_t highest) {
    const std::string format = fmt::format("%u of {}", highest);
    ImGui::SliderScalar(label, ImGuiDataType_U32, &value, &lowest, &highest, format.c_str(),
                        ImGuiSliderFlags_AlwaysClamp);
}

std::string megabytes(uint64_t bytes) {
    return fmt::format("{:.2f} MB", 1e-6 * static_cast<double>(bytes));
}

void draw_settings(const OverlayInfo& info, const ViewRange& range, ViewState& view) {
    if (begin_panel("settings", 0.0f, 0.0f)) {
        text(info.title);
        dim_text(fmt::format("{} vertices, {} triangles, {} poses", info.num_vertices,
                             info.num_triangles, range.num_poses));
        if (!info.loading.empty()) text(info.loading);
        ImGui::Separator();
        ImGui::PushItemWidth(12.0f * ImGui::GetFontSize());
        count_slider("transfer components", view.limits.transfer_components, 0,
                     range.transfer_components);
        if (range.vertex_components > 0 && !info.vertex_components.empty()) {
            count_slider(info.vertex_components.c_str(), view.limits.vertex_components, 0,
                         range.vertex_components);
        }
        count_slider("geometry components", view.limits.geometry_components, 0,
                     range.geometry_components);
        count_slider("bands", view.limits.bands, 1, range.bands);
        ImGui::SliderFloat("exposure", &view.tone_curve.exposure_ev, -8.0f, 8.0f, "%.2f EV");
        ImGui::SliderFloat("gamma", &view.tone_curve.gamma, 0.0f, 5.0f,
                           view.tone_curve.gamma == 0.0f ? "sRGB" : "%.1f",
                           ImGuiSliderFlags_AlwaysClamp);
        // Below 1 a curve is of no use; the low end of the slider means sRGB.
        if (view.tone_curve.gamma < 1.0f) view.tone_curve.gamma = 0.0f;
        auto rotation_deg = static_cast<float>(view.env_rotation_deg);
        if (ImGui::SliderFloat("light turned", &rotation_deg, -180.0f, 180.0f, "%.0f deg")) {
            view.env_rotation_deg = static_cast<double>(rotation_deg);
        }
        ImGui::PopItemWidth();
        ImGui::Checkbox("turn by itself", &view.turning);
        dim_text("light: " + info.environment);
        ImGui::Separator();
        text(fmt::format("{:.2f} ms, {:.0f} frames/s", info.frame_ms,
                         info.frame_ms > 0.0 ? 1000.0 / info.frame_ms : 0.0));
        text(fmt::format("{} in memory, {} file", megabytes(info.cost.bytes),
                         megabytes(info.file_bytes)));
        text(fmt::format("{} multiply-adds per vertex", info.cost.multiply_adds));
        dim_text(info.renderer);
        dim_text("H: keys");
    }
    ImGui::End();
}

void draw_scrub_bar(const ViewRange& range, ViewState& view) {
    const float width = ImGui::GetIO().DisplaySize.x - 2.0f * kMargin;
    ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
    if (begin_panel("poses", 0.0f, 1.0f)) {
        if (ImGui::Button(view.playing ? "pause" : "play",
                          ImVec2(4.0f * ImGui::GetFontSize(), 0))) {
            view.playing = !view.playing;
        }
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-1.0f);
        const auto last = static_cast<float>(range.num_poses - 1);
        float pose = std::min(static_cast<float>(view.time), last);
        const std::string format = fmt::format("pose %.2f of 0 to {}", range.num_poses - 1);
        if (ImGui::SliderFloat("##pose", &pose, 0.0f, last, format.c_str(),
                               ImGuiSliderFlags_AlwaysClamp)) {
            view.time = static_cast<double>(pose);
            view.playing = false;
        }
    }
    ImGui::End();
}

void draw_help() {
    if (begin_panel("help", 1.0f, 0.0f)) {
        if (ImGui::BeginTable("keys", 2)) {
            for (const KeyRow& row : key_table()) {
                ImGui::TableNextColumn();
                text(row.keys);
                ImGui::TableNextColumn();
                text(row.meaning);
            }
            ImGui::TableNextColumn();
            text("drag");
            ImGui::TableNextColumn();
            text("orbit; right or middle: move; wheel: zoom");
            ImGui::TableNextColumn();
            text("drop an .exr");
            ImGui::TableNextColumn();
            text("change the light");
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

void draw_message(const std::string& message) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos(ImVec2(0.5f * size.x, 0.85f * size.y), ImGuiCond_Always,
                            ImVec2(0.5f, 1.0f));
    ImGui::SetNextWindowBgAlpha(kOpacity);
    if (ImGui::Begin("message", nullptr, kPanelFlags | ImGuiWindowFlags_NoInputs)) text(message);
    ImGui::End();
}

}  // namespace

void draw_overlay(const OverlayInfo& info, const ViewRange& range, ViewState& view) {
    if (view.show_panel) {
        draw_settings(info, range, view);
        draw_scrub_bar(range, view);
    }
    if (view.show_help) draw_help();
    if (!info.message.empty()) draw_message(info.message);
}

}  // namespace paim::player
