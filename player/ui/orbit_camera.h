// A camera that circles round a point, moved by the mouse.
#pragma once

#include "paim/mesh/bounds.h"
#include "paim/shade/camera.h"

namespace paim::player {

// Where the camera stands at first, relative to the frame that shows the whole animation.
struct CameraOptions {
    float azimuth_rad = 0.5f;  // frame_bounds()'s defaults
    float elevation_rad = 0.3f;
    float distance_factor = 1.0f;
};

// The camera that the options ask for: frame_bounds(), at distance_factor times its distance.
Camera start_camera(const CameraOptions& options, const Bounds& bounds, float aspect);

class OrbitCamera {
  public:
    // Shows all of the bounds, from where the options say.
    void frame(const CameraOptions& options, const Bounds& bounds, float aspect);

    // Mouse movements as fractions of the window's height, right and down positive.
    void orbit(float dx, float dy);
    void pan(float dx, float dy);

    // Steps of the mouse wheel; positive comes closer.
    void zoom(float steps);

    Camera camera() const;

  private:
    Vec3f target_ = Vec3f::Zero();
    float distance_ = 1.0f;  // scene units
    float framed_distance_ = 1.0f;
    float azimuth_rad_ = 0.0f;
    float elevation_rad_ = 0.0f;
};

}  // namespace paim::player
