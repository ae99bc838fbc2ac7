// What the surface shows instead of its light: one table for the command line, the panels and the
// help.
#pragma once

#include <span>
#include <string_view>

namespace paim::player {

enum class SurfaceView {
    lit,
    coefficient,
    normals,
    shape,
    albedo,
    groups,
    open_fraction,
    transfer_error,
    radiance_error,
    position_error,
};

struct SurfaceViewRow {
    SurfaceView view;
    std::string_view name;         // on the command line
    std::string_view words;        // in a panel
    std::string_view description;  // one sentence
};

// One row for each view, in the order of the enumeration.
std::span<const SurfaceViewRow> surface_views();

const SurfaceViewRow& row_of(SurfaceView view);

// The view of this name. Errors: usage, listing all names, if no view has it.
SurfaceView parse_surface_view(std::string_view name);

// Whether the view compares what the limits show with all that the file has.
constexpr bool is_error_view(SurfaceView view) {
    return view == SurfaceView::transfer_error || view == SurfaceView::radiance_error ||
           view == SurfaceView::position_error;
}

}  // namespace paim::player
