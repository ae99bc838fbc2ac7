// How much of the file is used, and what that costs and saves.
#include <fmt/format.h>

#include "player/ui/panels.h"
#include "player/ui/widgets.h"

namespace paim::player {

namespace {

// A share of the bake, or in words that it is not known.
std::string error_text(const std::optional<double>& total) {
    return total ? percent(*total) : "not stated";
}

void error_row(const char* what, const std::optional<double>& total, double dropped) {
    ImGui::TableNextColumn();
    text(what);
    ImGui::TableNextColumn();
    text(error_text(total));
    ImGui::TableNextColumn();
    text(percent(dropped));
}

void draw_errors(const Accuracy& accuracy) {
    if (!ImGui::BeginTable("errors", 3)) return;
    for (const char* heading : {"error", "to the bake", "left out"}) {
        ImGui::TableNextColumn();
        dim_text(heading);
    }
    error_row("transfer", accuracy.transfer_total, accuracy.transfer_dropped);
    error_row("positions", accuracy.position_total, accuracy.position_dropped);
    ImGui::EndTable();
    if (accuracy.transfer.theory_error) {
        dim_text(fmt::format("theory (E5): transfer {}\n             positions {}",
                             percent(*accuracy.transfer.theory_error),
                             accuracy.geometry.theory_error
                                 ? percent(*accuracy.geometry.theory_error)
                                 : "not known"));
    }
}

void draw_costs(const PanelInfo& info) {
    const Cost& cost = info.cost;
    if (!ImGui::BeginTable("costs", 2)) return;
    const auto row = [](const char* what, const std::string& value) {
        ImGui::TableNextColumn();
        dim_text(what);
        ImGui::TableNextColumn();
        text(value);
    };
    row("multiply-adds a vertex", fmt::format("{}", cost.multiply_adds));
    if (cost.cpu_multiply_adds > 0) {
        row("shared by all vertices", fmt::format("{}", cost.cpu_multiply_adds));
    }
    row("values in use", megabytes(cost.bytes));
    row("file", megabytes(info.file_bytes));
    row("on the GPU", megabytes(info.texture_bytes + info.buffer_bytes));
    row("frame", fmt::format("{:.2f} ms", info.frame_ms));
    ImGui::EndTable();
}

}  // namespace

void draw_accuracy(const PanelInfo& info, const ViewRange& range, ViewState& view) {
    const DecodeLimits& most = range.limits;
    count_slider("transfer components", view.limits.transfer_components, 0,
                 most.transfer_components);
    if (most.vertex_components > 0 && !info.vertex_components.empty()) {
        count_slider(info.vertex_components.c_str(), view.limits.vertex_components, 0,
                     most.vertex_components);
    }
    count_slider("geometry components", view.limits.geometry_components, 0,
                 most.geometry_components);
    count_slider("bands", view.limits.bands, 1, most.bands);
    const char* const kComparisons[] = {"not shown", "wipe", "side by side"};
    auto comparison = static_cast<size_t>(view.comparison);
    if (choice("whole file", comparison, std::size(kComparisons),
               [&](size_t i) { return kComparisons[i]; })) {
        view.comparison = static_cast<Comparison>(comparison);
    }
    if (view.comparison == Comparison::wipe) {
        number_slider("split", view.split, 0.0, 1.0, "%.2f");
    }
    if (info.accuracy) {
        draw_errors(*info.accuracy);
        if (!info.accuracy_note.empty()) note_text(info.accuracy_note);
    } else {
        dim_text("errors: once the whole file is there");
    }
    draw_costs(info);
}

}  // namespace paim::player
