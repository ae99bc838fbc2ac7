// The camera, crowds, and what is written to files.
#include <fmt/format.h>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

void draw_camera(const PanelInfo& info, ViewState& view, PanelRequests& requests) {
    const auto button = [&](const char* label, WindowCommand command) {
        if (ImGui::Button(label)) requests.commands.push_back(command);
    };
    button("show all poses", WindowCommand::frame_all);
    ImGui::SameLine();
    button("show this pose", WindowCommand::frame_pose);
    bool follows = view.camera.target == CameraTarget::pose;
    if (ImGui::Checkbox("follow the body", &follows)) {
        requests.commands.push_back(WindowCommand::follow_body);
    }
    number_slider("turntable", view.camera.turn_speed_deg, -90.0, 90.0, "%.0f deg/s");
    count_slider("copies", view.num_instances, 1, 100);
    button("save PNG", WindowCommand::snapshot_png);
    ImGui::SameLine();
    button("save EXR", WindowCommand::snapshot_exr);
    ImGui::SameLine();
    button("save view", WindowCommand::save_view);
    ImGui::SameLine();
    button(info.recorded ? "stop" : "record", WindowCommand::record);
    if (info.recorded) {
        ImGui::ProgressBar(*info.recorded, ImVec2(18.0f * ImGui::GetFontSize(), 0.0f));
    }
    button("open a file", WindowCommand::open_file);
}

}  // namespace paim::player
