// The bar at the lower edge: time, speed, and what happens at the ends.
#include <fmt/format.h>

#include <algorithm>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

namespace {

void draw_bar(const ViewRange& range, float poses_per_second, Animation& animation) {
    ImGui::SetNextItemWidth(-1.0f);
    const double last = static_cast<double>(range.num_poses) - 1.0;
    double pose = shown_time(animation, range.num_poses);
    const std::string format = fmt::format("pose %.2f of 0 to {}, {:.2f} s", range.num_poses - 1,
                                           pose / std::max(1e-3, double{poses_per_second}));
    if (number_slider("##pose", pose, 0.0, last, format.c_str())) show_pose(animation, pose);
}

void draw_controls(Animation& animation) {
    if (ImGui::Button(animation.playing ? "pause" : "play",
                      ImVec2(4.0f * ImGui::GetFontSize(), 0))) {
        animation.playing = !animation.playing;
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(7.0f * ImGui::GetFontSize());
    number_slider("##speed", animation.speed, -kMaxSpeed, kMaxSpeed, "speed %.2f");
    ImGui::SameLine();
    if (ImGui::Button(animation.ping_pong ? "there and back" : "loop")) {
        animation.ping_pong = !animation.ping_pong;
    }
    ImGui::SameLine();
    ImGui::Checkbox("in-betweens", &animation.in_betweens);
}

}  // namespace

float timeline_height() {
    const ImGuiStyle& style = ImGui::GetStyle();
    return 2.0f * style.WindowPadding.y + 2.0f * ImGui::GetFrameHeight() + style.ItemSpacing.y;
}

void draw_timeline(const ViewRange& range, float poses_per_second, ViewState& view) {
    Animation& animation = view.animation;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowSize(ImVec2(size.x - 2.0f * panel_margin(), 0.0f));
    if (begin_panel("poses", ImVec2(panel_margin(), size.y - panel_margin()), ImVec2(0.0f, 1.0f))) {
        draw_bar(range, poses_per_second, animation);
        draw_controls(animation);
    }
    ImGui::End();
}

}  // namespace paim::player
