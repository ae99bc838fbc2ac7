// What the surface shows, and what its colours mean.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "player/inspect/false_color.h"
#include "player/ui/panels.h"
#include "player/ui/widgets.h"
#include "player/view/view_fields.h"

namespace paim::player {

namespace {

// The colours of a scale, from its lowest to its highest value.
void draw_scale(const Legend& legend) {
    constexpr int kSteps = 64;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = 18.0f * ImGui::GetFontSize(), height = ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (int i = 0; i < kSteps; ++i) {
        const float share = static_cast<float>(i) / (kSteps - 1);
        const Vec3f linear = legend.kind == ScaleKind::heat
                                 ? heat_color(share)
                                 : signed_color(2.0f * share - 1.0f, 1.0f);
        const ToneCurve curve;
        list.AddRectFilled(
            ImVec2(corner.x + width * i / kSteps, corner.y),
            ImVec2(corner.x + width * (i + 1) / kSteps, corner.y + height),
            IM_COL32(curve.apply(linear[0]), curve.apply(linear[1]), curve.apply(linear[2]), 255));
    }
    ImGui::Dummy(ImVec2(width, height));
    const std::string highest = fmt::format("{:.3g}", legend.highest);
    text(fmt::format("{:.3g}", legend.lowest));
    ImGui::SameLine(width - ImGui::CalcTextSize(highest.c_str()).x +
                    ImGui::GetStyle().WindowPadding.x);
    text(highest);
}

std::string coefficient_name(uint32_t i) {
    const auto l = static_cast<uint32_t>(std::sqrt(static_cast<double>(i)));
    const int m = static_cast<int>(i) - static_cast<int>(l * (l + 1));
    return fmt::format("{} (l {}, m {})", i, l, m);
}

void choose_coefficient(const ViewRange& range, ViewState& view) {
    const uint32_t last = range.limits.bands * range.limits.bands - 1;
    const std::string format = coefficient_name(std::min(view.coefficient, last));
    const uint32_t first = 0;
    ImGui::SliderScalar("coefficient", ImGuiDataType_U32, &view.coefficient, &first, &last,
                        format.c_str(), ImGuiSliderFlags_AlwaysClamp);
    constexpr std::array<const char*, 4> kChannels = {"red", "green", "blue", "luminance"};
    size_t channel = view.channel;
    if (choice("channel", channel, kChannels.size(), [&](size_t i) { return kChannels[i]; })) {
        view.channel = static_cast<uint32_t>(channel);
    }
}

void choose_gloss(ViewState& view) {
    const Names<GlossDetail> names = gloss_detail_names();
    size_t chosen = 0;
    while (names[chosen].second != view.gloss) ++chosen;
    ImGui::SetNextItemWidth(8.0f * ImGui::GetFontSize());
    if (choice("gloss", chosen, names.size(), [&](size_t i) { return names[i].first; })) {
        view.gloss = names[chosen].second;
    }
}

}  // namespace

void draw_surface(const PanelInfo& info, const ViewRange& range, ViewState& view) {
    const auto rows = surface_views();
    auto chosen = static_cast<size_t>(view.surface);
    ImGui::SetNextItemWidth(15.0f * ImGui::GetFontSize());
    if (choice("surface", chosen, rows.size(), [&](size_t i) { return rows[i].words; })) {
        view.surface = rows[chosen].view;
    }
    note_text(std::string(row_of(view.surface).description));
    if (view.surface == SurfaceView::coefficient) choose_coefficient(range, view);
    if (info.has_gloss) choose_gloss(view);
    if (info.has_textures) ImGui::Checkbox("textures", &view.textures);
    ImGui::Checkbox("edges of triangles", &view.edges);
    if (info.coefficient_lobe != nullptr) {
        picture(*info.coefficient_lobe, 8.0f * ImGui::GetFontSize(), Rows::bottom_up);
        dim_text("the coefficient's own function of direction");
    }
}

void draw_legend(const PanelInfo& info) {
    if (info.legend == nullptr) return;
    const Legend& legend = *info.legend;
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    if (begin_panel("legend", ImVec2(size.x - panel_margin(), panel_margin()),
                    ImVec2(1.0f, 0.0f))) {
        text_in_lines(legend.title);
        if (legend.kind != ScaleKind::none) draw_scale(legend);
        if (legend.mean_error) text(fmt::format("mean {:.3g}", *legend.mean_error));
        if (legend.worst) {
            text_in_lines(fmt::format("worst {:.3g}, vertex {} of part {}{}", legend.worst->value,
                                      legend.worst->vertex, legend.worst->part,
                                      info.worst ? " (circled)" : ""));
        }
        if (!legend.note.empty()) note_text(legend.note);
    }
    ImGui::End();
}

void draw_markers(const PanelInfo& info) {
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const auto circle = [&](const std::optional<PicturePlace>& place, ImU32 color) {
        if (!place) return;
        const ImVec2 center(place->x * size.x, place->y * size.y);
        const float radius = 0.7f * ImGui::GetFontSize();
        list.AddCircle(center, radius, IM_COL32(0, 0, 0, 255), 0, 4.0f);
        list.AddCircle(center, radius, color, 0, 2.0f);
    };
    circle(info.worst, IM_COL32(255, 255, 255, 255));
    circle(info.picked_place, IM_COL32(255, 210, 60, 255));
}

}  // namespace paim::player
