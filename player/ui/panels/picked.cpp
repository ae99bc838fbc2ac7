// The vertex that was clicked: its transfer, and its error over time.
#include <fmt/format.h>

#include <algorithm>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

void draw_picked(const PanelInfo& info, ViewState& view) {
    if (!info.picked) return;
    const PickedInfo& picked = *info.picked;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const ImVec2 place(size.x - panel_margin(), size.y - 2.0f * panel_margin() - timeline_height());
    if (begin_panel("picked", place, ImVec2(1.0f, 1.0f))) {
        text(fmt::format("vertex {} of part {}", picked.vertex.vertex, picked.vertex.part));
        ImGui::SameLine();
        const bool closed = ImGui::SmallButton("close");
        if (picked.lobe != nullptr) {
            picture(*picked.lobe, 9.0f * ImGui::GetFontSize(), Rows::bottom_up);
            dim_text("transfer, by direction of light");
        }
        if (!picked.history.empty()) {
            const float highest = *std::max_element(picked.history.begin(), picked.history.end());
            dim_text(fmt::format("{}, pose by pose", picked.history_title));
            ImGui::PlotLines("##history", picked.history.data(),
                             static_cast<int>(picked.history.size()), 0,
                             fmt::format("most {}", percent(double{highest})).c_str(), 0.0f,
                             std::max(highest, 1e-9f),
                             ImVec2(18.0f * ImGui::GetFontSize(), 5.0f * ImGui::GetFontSize()));
            if (picked.history.size() < picked.num_poses) {
                dim_text(fmt::format("{} of {} poses", picked.history.size(), picked.num_poses));
            }
        }
        if (closed) view.picked.reset();
    }
    ImGui::End();
}

}  // namespace paim::player
