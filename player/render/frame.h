// What one picture shows.
#pragma once

#include "paim/base/vector.h"
#include "paim/codec/mesh_decoder.h"
#include "paim/mesh/bounds.h"
#include "paim/shade/camera.h"

namespace paim::player {

struct Background {
    enum class Kind { environment, color };
    Kind kind = Kind::environment;
    Vec3f color = Vec3f::Zero();  // linear radiance
};

// Part of a picture: its lower left corner and its size, as fractions of the picture's.
struct PictureRegion {
    float left = 0.0f, bottom = 0.0f;
    float width = 1.0f, height = 1.0f;

    bool is_whole() const {
        return left == 0.0f && bottom == 0.0f && width == 1.0f && height == 1.0f;
    }
};

// Lengths are in the model's unit. Cameras and depths take squares of them in single precision, so
// that the model has to be of about unit size (player/read_asset.h).
struct Frame {
    double time = 0.0;  // in poses
    DecodeLimits limits;
    double env_rotation_rad = 0.0;  // about +Y, counter-clockwise seen from above
    Camera camera;
    Bounds bounds;  // hold the mesh at this time; near and far planes come from them
    Background background;
    PictureRegion region;  // what the target shows; the camera is that of the whole picture
};

}  // namespace paim::player
