// Orbit, pan, zoom.
#include "player/ui/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

constexpr float kOrbitRadPerHeight = static_cast<float>(kPi);
constexpr float kZoomPerStep = 0.9f;
constexpr float kMaxZoom = 1000.0f;
constexpr float kMaxElevationRad = 1.55f;  // never over the pole, where up has no direction

}  // namespace

Camera start_camera(const CameraOptions& options, const Bounds& bounds, float aspect) {
    Camera camera = frame_bounds(bounds, aspect, options.azimuth_rad, options.elevation_rad);
    camera.eye = camera.target + options.distance_factor * (camera.eye - camera.target);
    return camera;
}

void OrbitCamera::frame(const CameraOptions& options, const Bounds& bounds, float aspect) {
    const Camera start = start_camera(options, bounds, aspect);
    target_ = start.target;
    distance_ = (start.eye - start.target).norm();
    framed_distance_ = distance_;
    azimuth_rad_ = options.azimuth_rad;
    elevation_rad_ = options.elevation_rad;
}

void OrbitCamera::orbit(float dx, float dy) {
    azimuth_rad_ =
        std::remainder(azimuth_rad_ - kOrbitRadPerHeight * dx, 2.0f * static_cast<float>(kPi));
    elevation_rad_ =
        std::clamp(elevation_rad_ + kOrbitRadPerHeight * dy, -kMaxElevationRad, kMaxElevationRad);
}

void OrbitCamera::pan(float dx, float dy) {
    // What lies at the target stays under the pointer.
    const Camera current = camera();
    const float height = 2.0f * distance_ * std::tan(0.5f * current.vertical_fov_rad);
    const Eigen::Matrix3f axes = current.axes();
    target_ += height * (dy * axes.col(1) - dx * axes.col(0));
}

void OrbitCamera::zoom(float steps) {
    const float distance = distance_ * std::pow(kZoomPerStep, std::clamp(steps, -20.0f, 20.0f));
    distance_ = std::clamp(distance, framed_distance_ / kMaxZoom, framed_distance_ * kMaxZoom);
}

Camera OrbitCamera::camera() const {
    Camera camera;
    camera.target = target_;
    camera.eye = target_ + distance_ * Vec3f(std::sin(azimuth_rad_) * std::cos(elevation_rad_),
                                             std::sin(elevation_rad_),
                                             std::cos(azimuth_rad_) * std::cos(elevation_rad_));
    return camera;
}

}  // namespace paim::player
