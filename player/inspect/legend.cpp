// Titles of views.
#include "player/inspect/legend.h"

#include <array>

#include "paim/base/message.h"
#include "paim/sh/index.h"
#include "player/inspect/transfer_channel.h"

namespace paim::player {

namespace {

std::string coefficient_title(uint32_t coefficient, uint32_t channel) {
    constexpr std::array kChannels{"red", "green", "blue"};
    const int i = static_cast<int>(coefficient);
    const int l = sh::band_of(i);
    return message("transfer, l = {}, m = {}, {} (no unit)", l, i - sh::index(l, 0),
                   channel < kLuminance ? kChannels[channel] : "luminance");
}

}  // namespace

std::string legend_title(SurfaceView view, uint32_t coefficient, uint32_t channel) {
    switch (view) {
        case SurfaceView::lit:
            return "radiance (linear RGB)";
        case SurfaceView::coefficient:
            return coefficient_title(coefficient, channel);
        case SurfaceView::normals:
            return "normals (x, y, z as red, green, blue)";
        case SurfaceView::shape:
            return "shape alone";
        case SurfaceView::albedo:
            return "albedo (linear RGB, 0 to 1)";
        case SurfaceView::groups:
            return "groups of vertices that share points";
        case SurfaceView::open_fraction:
            return "open fraction (1: nothing occludes)";
        case SurfaceView::transfer_error:
            return "error of the transfer (fraction of the RMS over vertices)";
        case SurfaceView::radiance_error:
            return "error of the radiance (fraction of the RMS over vertices)";
        case SurfaceView::position_error:
            return "error of the positions (fraction of the pose's diagonal)";
    }
    return {};
}

}  // namespace paim::player
