// The panels over the picture: settings and their cost, the scrub bar, the help.
#pragma once

#include <string>

#include "player/render/cost.h"
#include "player/ui/view_state.h"

namespace paim::player {

// What the panels show besides the view.
struct OverlayInfo {
    std::string title;        // the file's name
    std::string environment;  // the light's
    std::string renderer;
    std::string message;  // of the last moments, or empty
    std::string loading;  // how much of the file is there, or empty
    uint64_t file_bytes = 0;
    uint32_t num_vertices = 0;
    uint32_t num_triangles = 0;
    double frame_ms = 0.0;
    Cost cost{};
    std::string vertex_components;  // what the codec calls them, if there are any
};

// Between begin_frame() and end_frame(). Sliders change the view.
void draw_overlay(const OverlayInfo& info, const ViewRange& range, ViewState& view);

}  // namespace paim::player
