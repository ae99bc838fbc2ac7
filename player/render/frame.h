// What one picture shows.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "paim/base/vector.h"
#include "paim/codec/decode_limits.h"
#include "paim/image/tone.h"
#include "paim/light/light.h"
#include "paim/mesh/bounds.h"
#include "paim/shade/camera.h"

namespace paim::player {

struct Background {
    enum class Kind {
        environment,
        blurred,  // the environment, out of focus
        color,
    };
    Kind kind = Kind::environment;
    Vec3f color = Vec3f::Zero();  // linear radiance

    bool operator==(const Background&) const = default;
};

// Part of a picture: its lower left corner and its size, as fractions of the picture's.
struct PictureRegion {
    float left = 0.0f, bottom = 0.0f;
    float width = 1.0f, height = 1.0f;

    bool is_whole() const {
        return left == 0.0f && bottom == 0.0f && width == 1.0f && height == 1.0f;
    }
};

// Where the radiance of gloss towards the eye is summed: at vertices, whose sums are interpolated, or at
// pixels, for which outgoing coefficients are interpolated (vertices where this driver cannot). Narrow
// lobes need the second.
enum class GlossDetail { none, vertex, pixel };

// One copy of the asset.
struct Instance {
    double time_offset = 0.0;      // in poses from the time of the frame, up to ±(P−1)
    Vec3d offset = Vec3d::Zero();  // from where the asset stands, scene units
};

// [parts][V] linear RGB.
using PartColors = std::vector<std::vector<Vec3f>>;

// Lengths are in the model's unit. Cameras and depths take squares of them in single precision, so
// that the model has to be of about unit size (player/read_asset.h).
struct Frame {
    double time = 0.0;  // in poses
    DecodeLimits limits;
    LightCoefficients light;  // of the scene
    // Colours to show instead of radiance, of the pose at a time; valid until the next call.
    std::function<const PartColors&(double time)> colors;
    GlossDetail gloss = GlossDetail::pixel;
    bool textures = true;  // where faces have images; otherwise the albedo of their vertices
    bool edges = false;    // draws the edges of all triangles, too
    std::vector<Instance> instances{Instance{}};
    Camera camera;
    Bounds bounds;  // hold all instances at this time; near and far planes come from them
    Background background;
    // From directions of the world to those of the environment's map.
    Eigen::Matrix3f environment_from_world = Eigen::Matrix3f::Identity();
    float environment_strength = 1.0f;  // factor of the map's radiance
    // Through which curve the picture is drawn; nothing: linear radiance.
    std::optional<ToneCurve> display;
    PictureRegion region;  // what the target shows; the camera is that of the whole picture
};

// The time of an instance, in poses: that of the frame where it has no offset.
double time_of(const Frame& frame, const Instance& instance, uint32_t num_poses);

}  // namespace paim::player
