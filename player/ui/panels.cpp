// The main panel, and which panels are there.
#include "player/ui/panels.h"

#include <fmt/format.h>

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

void draw_main(const PanelInfo& info, const ViewRange& range, PanelRequests& requests,
               ViewState& view) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float below = 4.0f * ImGui::GetFontSize();  // the timeline
    ImGui::SetNextWindowSizeConstraints(ImVec2(0.0f, 0.0f),
                                        ImVec2(size.x, size.y - 2.0f * panel_margin() - below));
    if (begin_panel("settings", ImVec2(panel_margin(), panel_margin()), ImVec2(0.0f, 0.0f))) {
        draw_model(info, range);
        ImGui::PushItemWidth(11.0f * ImGui::GetFontSize());
        if (section("Accuracy", true)) draw_accuracy(info, range, view);
        if (section("Surface", true)) draw_surface(info, range, view);
        if (section("Light", false)) draw_light(info, view);
        if (section("Picture", false)) draw_picture(view, requests);
        if (section("Camera and files", false)) draw_camera(info, view, requests);
        ImGui::PopItemWidth();
        dim_text(info.renderer);
        dim_text(info.decoder);
        dim_text("H: keys, Tab: no panels");
    }
    ImGui::End();
}

void draw_message(const std::string& message) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    if (begin_panel("message", ImVec2(0.5f * size.x, 0.85f * size.y), ImVec2(0.5f, 1.0f),
                    ImGuiWindowFlags_NoInputs)) {
        text(message);
    }
    ImGui::End();
}

}  // namespace

PanelRequests draw_panels(const PanelInfo& info, const ViewRange& range, PanelState& state,
                          ViewState& view) {
    PanelRequests requests;
    if (state.show_panels) {
        draw_main(info, range, requests, view);
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

void draw_help() {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const auto row = [](const std::string& keys, const std::string& meaning) {
        ImGui::TableNextColumn();
        text(keys);
        ImGui::TableNextColumn();
        text(meaning);
    };
    if (begin_panel("help", ImVec2(0.5f * size.x, 0.5f * size.y), ImVec2(0.5f, 0.5f))) {
        if (ImGui::BeginTable("keys", 2)) {
            for (const KeyGroup& group : key_groups()) {
                ImGui::TableNextColumn();
                dim_text(group.title);
                ImGui::TableNextColumn();
                for (const KeyRow& keys : group.rows) row(keys.keys, keys.meaning);
            }
            row("drag", "turn the camera; right or middle button: move it; wheel: come closer");
            row("Ctrl+drag", "turn the light");
            row("click", "pick a vertex");
            row("drop a file", ".paim: another model, .exr: another light");
            ImGui::EndTable();
        }
    }
    ImGui::End();
}

}  // namespace paim::player
