// A camera that circles round a point, moved by the mouse.
#pragma once

#include "paim/base/vector.h"
#include "paim/shade/camera.h"

namespace paim::player {

struct OrbitCamera {
    // What it looks at, in the unit of the model; relative to the body where the camera follows it.
    Vec3d target = Vec3d::Zero();
    double distance = 1.0;
    double azimuth_rad = double{kDefaultAzimuth_rad};
    double elevation_rad = double{kDefaultElevation_rad};
    // The distance of the last framing: zooming stays within a factor of 1000.
    double framed_distance = 1.0;

    bool operator==(const OrbitCamera&) const = default;

    // Stands where this camera stands and looks at the same. It does not roll.
    static OrbitCamera of(const Camera& camera);

    // Mouse movements as fractions of the window's height, right and down positive.
    void orbit(double dx, double dy);
    void pan(double dx, double dy);

    // Steps of the mouse wheel; positive comes closer.
    void zoom(double steps);

    // origin  that the target is relative to
    Camera camera(const Vec3d& origin = Vec3d::Zero()) const;
};

}  // namespace paim::player
