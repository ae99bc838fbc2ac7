// What the window shows, as the keys and sliders change it.
#pragma once

#include <cstdint>

#include "paim/image/tone.h"
#include "player/render/frame.h"

namespace paim::player {

struct ViewState {
    double time =
        0.0;  // in poses, 0 … P while playing: the last pose is held as long as the others
    bool playing = true;
    DecodeLimits limits;  // never above what the model has
    ToneCurve tone_curve;
    double env_rotation_deg = 0.0;
    bool turning = false;  // the light, by itself
    Background background;
    bool show_help = false;
    bool show_panel = true;
};

// The largest values of a view: what the model has.
struct ViewRange {
    uint32_t num_poses = 1;
    uint32_t geometry_components = 0;
    uint32_t transfer_components = 0;
    uint32_t bands = 1;
    uint32_t vertex_components = 0;
};

// The model has become another: what showed all there was shows all there is now, up to what was
// asked for at the start, and what was lowered stays.
void follow(ViewState& view, const ViewRange& before, const ViewRange& now,
            const DecodeLimits& wanted);

// Moves pose and light on by the time that has passed. Playing starts over after the last pose.
void advance(ViewState& view, const ViewRange& range, float frames_per_second, double elapsed_s);

}  // namespace paim::player
