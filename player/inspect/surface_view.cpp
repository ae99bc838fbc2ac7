// The table of views.
#include "player/inspect/surface_view.h"

#include <array>
#include <string>

#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim::player {

namespace {

constexpr std::array kViews{
    SurfaceViewRow{SurfaceView::lit, "lit", "light", "The surface under the light, as it is."},
    SurfaceViewRow{SurfaceView::coefficient, "coefficient", "transfer coefficient",
                   "One coefficient of the transfer, red above zero and blue below."},
    SurfaceViewRow{SurfaceView::normals, "normals", "normals",
                   "The normal of each vertex: x, y and z of the scene as red, green and blue."},
    SurfaceViewRow{SurfaceView::shape, "shape", "shape alone",
                   "The geometry in grey under a soft light of its own, without any transfer."},
    SurfaceViewRow{SurfaceView::albedo, "albedo", "albedo",
                   "The diffuse reflectance of each vertex."},
    SurfaceViewRow{SurfaceView::groups, "groups", "groups of vertices",
                   "Which vertices the codec makes of the same stored points, a colour each."},
    SurfaceViewRow{SurfaceView::open_fraction, "open-fraction", "open fraction",
                   "How much of constant light reaches a vertex, 1 where nothing occludes it."},
    SurfaceViewRow{SurfaceView::transfer_error, "transfer-error", "error of the transfer",
                   "How far the transfer within the limits is from all that the file has of it."},
    SurfaceViewRow{SurfaceView::radiance_error, "radiance-error", "error of the radiance",
                   "How far the radiance within the limits is from that of the whole file."},
    SurfaceViewRow{SurfaceView::position_error, "position-error", "error of the positions",
                   "How far a vertex within the limits is from its place in the whole file."},
};

}  // namespace

std::span<const SurfaceViewRow> surface_views() {
    return kViews;
}

const SurfaceViewRow& row_of(SurfaceView view) {
    const auto number = static_cast<size_t>(view);
    PAIM_CHECK_LT(number, kViews.size());
    return kViews[number];
}

SurfaceView parse_surface_view(std::string_view name) {
    std::string names;
    for (const SurfaceViewRow& row : kViews) {
        if (row.name == name) return row.view;
        names += names.empty() ? "" : ", ";
        names += row.name;
    }
    throw_usage("--surface: expected one of {}, got '{}'", names, name);
}

}  // namespace paim::player
