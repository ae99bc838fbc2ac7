// Everything about a picture that a person can change: by keys, panels, options or a view file.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "paim/codec/decode_limits.h"
#include "paim/image/tone.h"
#include "player/inspect/surface_view.h"
#include "player/inspect/transfer_channel.h"
#include "player/light/key_light.h"
#include "player/light/light_orientation.h"
#include "player/render/frame.h"
#include "player/view/animation.h"
#include "player/view/orbit_camera.h"

namespace paim::player {

// What the camera looks at.
enum class CameraTarget {
    all,    // a fixed place, from which all poses are seen
    pose,   // the body, wherever it goes
    point,  // a fixed place that an option gave
};

// Two pictures in one: the view within its limits, and the whole file.
enum class Comparison { none, wipe, side_by_side };

// Ranges of options, files and sliders.
constexpr double kMaxTurnSpeed_deg = 360.0;  // a second
constexpr double kMaxAngle_deg = 36000.0;    // of the light
constexpr double kMaxStrength = 1e6;
constexpr float kLowestGamma = 0.1f, kHighestGamma = 10.0f;  // or 0: the sRGB curve
constexpr uint32_t kMaxCoefficient = 4095;                   // of 64 bands
constexpr uint32_t kMostInstances = 10000;

struct LightView {
    LightOrientation orientation;
    bool turning = true;           // the environment, by itself
    double turn_speed_deg = 12.0;  // a second, about +Y
    double strength = 1.0;         // of the environment
    bool key_on = false;
    KeyLight key;

    bool operator==(const LightView&) const = default;
};

struct CameraView {
    OrbitCamera orbit;
    CameraTarget target = CameraTarget::all;
    double turn_speed_deg = 0.0;  // a second: a turntable

    bool operator==(const CameraView&) const = default;
};

struct PickedVertex {
    uint32_t part = 0, vertex = 0;

    bool operator==(const PickedVertex&) const = default;
};

struct ViewState {
    Animation animation;
    DecodeLimits limits;  // never above what the model has
    LightView light;
    CameraView camera;
    ToneCurve tone_curve;
    Background background;
    SurfaceView surface = SurfaceView::lit;
    uint32_t coefficient = 0;  // of SurfaceView::coefficient
    uint32_t channel = kLuminance;
    GlossDetail gloss = GlossDetail::pixel;
    bool textures = true;  // images where faces have them, instead of the albedo of vertices
    bool edges = false;
    Comparison comparison = Comparison::none;
    double split = 0.5;  // where a wipe divides the picture, 0 at the left
    uint32_t num_instances = 1;
    std::optional<PickedVertex> picked;

    bool operator==(const ViewState&) const = default;
};

// The largest values of a view: what the model has.
struct ViewRange {
    uint32_t num_poses = 1;
    DecodeLimits limits;
};

// The model has become another: what showed all there was shows all there is now, up to what was
// asked for at the start, and what was lowered stays.
void follow(ViewState& view, const ViewRange& before, const ViewRange& now,
            const DecodeLimits& wanted);

// Moves pose and light on by the time that has passed.
void advance(ViewState& view, uint32_t num_poses, double poses_per_second, double elapsed_s);

}  // namespace paim::player
