// The main panel, and which panels are there.
#include "player/ui/panels.h"

#include <fmt/format.h>

#include <algorithm>

#include "player/ui/widgets.h"

namespace paim::player {

namespace {

void draw_model(const PanelInfo& info, const ViewRange& range) {
    text(info.title);
    dim_text(fmt::format("{} vertices, {} triangles, {} poses", info.num_vertices,
                         info.num_triangles, range.num_poses));
    if (!info.loading.empty()) text(info.loading);
}

bool section(const char* title, bool open) {
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void draw_main(const PanelInfo& info, const ViewRange& range, PanelState& state,
               PanelRequests& requests, ViewState& view) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float highest = size.y - 3.0f * panel_margin() - timeline_height();
    ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f), ImVec2(size.x, highest));
    if (begin_panel("settings", ImVec2(panel_margin(), panel_margin()), ImVec2(0.0f, 0.0f))) {
        draw_model(info, range);
        ImGui::PushItemWidth(11.0f * ImGui::GetFontSize());
        if (section("Accuracy", true)) draw_accuracy(info, range, view);
        if (section("Surface", true)) draw_surface(info, range, view);
        state.light_is_open = section("Light", false);
        if (state.light_is_open) draw_light(info, view);
        if (section("Picture", false)) draw_picture(view, requests);
        if (section("Camera and files", false)) draw_camera(info, view, requests);
        ImGui::PopItemWidth();
        dim_text(info.renderer);
        note_text(info.decoder);
        dim_text("H: keys, Tab: no panels");
    }
    ImGui::End();
}

void draw_message(const std::string& message) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    if (begin_panel("message", ImVec2(0.5f * size.x, 0.85f * size.y), ImVec2(0.5f, 1.0f),
                    ImGuiWindowFlags_NoInputs)) {
        // Long paths go on in the next line.
        const ImVec2 whole = ImGui::CalcTextSize(message.c_str());
        ImGui::PushTextWrapPos(std::min(whole.x + 1.0f, 0.85f * size.x));
        text(message);
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace

PanelRequests draw_panels(const PanelInfo& info, const ViewRange& range, PanelState& state,
                          ViewState& view) {
    PanelRequests requests;
    if (state.show_panels) {
        draw_main(info, range, state, requests, view);
        draw_timeline(range, info.poses_per_second, view);
        draw_legend(info);
        draw_picked(info, view);
        draw_markers(info);
    }
    draw_open(state, requests);
    if (state.show_help) draw_help();
    if (!info.message.empty()) draw_message(info.message);
    return requests;
}

namespace {

const KeyGroup& mouse_help() {
    static const KeyGroup group = {
        "Mouse and files",
        {{"drag", "turn the camera", {}},
         {"right drag", "move the camera; the middle button, too", {}},
         {"wheel", "come closer, go away", {}},
         {"Ctrl+drag", "turn the light", {}},
         {"click", "pick a vertex", {}},
         {"drop a file", ".paim: another model, .exr: another light", {}}}};
    return group;
}

void draw_key_group(const KeyGroup& group) {
    dim_text(group.title);
    if (!ImGui::BeginTable(group.title.c_str(), 2, ImGuiTableFlags_SizingFixedFit)) return;
    ImGui::TableSetupColumn("keys", ImGuiTableColumnFlags_WidthFixed, 8.0f * ImGui::GetFontSize());
    for (const KeyRow& row : group.rows) {
        ImGui::TableNextColumn();
        text(row.keys);
        ImGui::TableNextColumn();
        text(row.meaning);
    }
    ImGui::EndTable();
}

}  // namespace

void draw_help() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const std::span<const KeyGroup> groups = key_groups();
    const size_t half = groups.size() / 2;
    // Panels under it would be read as part of it.
    constexpr float kOpaque = 1.0f;
    if (begin_panel("help", ImVec2(0.5f * size.x, 0.5f * size.y), ImVec2(0.5f, 0.5f), 0, kOpaque)) {
        ImGui::BeginGroup();
        for (const KeyGroup& group : groups.first(half)) draw_key_group(group);
        draw_key_group(mouse_help());
        ImGui::EndGroup();
        constexpr float kTwoColumns = 82.0f;  // what both need, in heights of letters
        if (size.x > kTwoColumns * ImGui::GetFontSize())
            ImGui::SameLine(0.0f, 2.0f * panel_margin());
        ImGui::BeginGroup();
        for (const KeyGroup& group : groups.subspan(half)) draw_key_group(group);
        ImGui::EndGroup();
    }
    ImGui::End();
}

}  // namespace paim::player
