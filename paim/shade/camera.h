// A pinhole camera that the player and the reference renderer share, so that their images line up.
#pragma once

#include "paim/base/vector.h"
#include "paim/mesh/bounds.h"

namespace paim {

struct Camera {
    Vec3f eye{0.0f, 0.0f, 1.0f};
    Vec3f target{0.0f, 0.0f, 0.0f};
    Vec3f up{0.0f, 1.0f, 0.0f};
    float vertical_fov_rad = 0.6108652f;  // 35°

    // Orthonormal right, up, backward (right-handed; the camera looks along −backward).
    Eigen::Matrix3f axes() const;

    // Unit direction of the ray through image coordinates u, v in [0, 1], (0, 0) the upper left
    // corner.
    Vec3f ray_direction(float u, float v, float aspect) const;
};

// The azimuth of the camera unless an option sets it.
constexpr float kDefaultAzimuth_rad = 0.5f;
constexpr float kDefaultElevation_rad = 0.3f;

// A camera that just sees all of the bounds.
// azimuth_rad    about +Y; 0 looks from +Z along −Z
// elevation_rad  above the horizon
Camera frame_bounds(const Bounds& bounds, float aspect, float azimuth_rad = kDefaultAzimuth_rad,
                    float elevation_rad = kDefaultElevation_rad);

}  // namespace paim
