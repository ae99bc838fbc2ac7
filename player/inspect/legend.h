// What the colours of a view mean, in words.
#pragma once

#include <cstdint>
#include <string>

#include "player/inspect/surface_view.h"

namespace paim::player {

enum class ScaleKind {
    none,           // colours are not those of a number
    signed_values,  // signed_color(), lowest = −highest
    heat,           // heat_color(), lowest = 0
};

constexpr ScaleKind scale_of(SurfaceView view) {
    if (view == SurfaceView::coefficient) return ScaleKind::signed_values;
    return view == SurfaceView::open_fraction || is_error_view(view) ? ScaleKind::heat
                                                                     : ScaleKind::none;
}

// What is shown, and its unit.
// coefficient, channel  of the views that have them; channel 0 … 2 or kLuminance
std::string legend_title(SurfaceView view, uint32_t coefficient, uint32_t channel);

}  // namespace paim::player
