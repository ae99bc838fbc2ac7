// Orbit, pan, zoom.
#include "player/view/orbit_camera.h"

#include <algorithm>
#include <cmath>

namespace paim::player {

namespace {

constexpr double kOrbitRadPerHeight = kPi;
constexpr double kZoomPerStep = 0.9;
constexpr double kMaxZoom = 1000.0;
constexpr double kMaxElevationRad = 1.55;  // never over the pole, where up has no direction

}  // namespace

OrbitCamera OrbitCamera::of(const Camera& camera) {
    const Vec3d back = (camera.eye - camera.target).cast<double>();
    OrbitCamera orbit;
    orbit.target = camera.target.cast<double>();
    orbit.distance = back.norm();
    orbit.framed_distance = orbit.distance;
    orbit.azimuth_rad = std::atan2(back.x(), back.z());
    orbit.elevation_rad = std::clamp(std::asin(std::clamp(back.y() / orbit.distance, -1.0, 1.0)),
                                     -kMaxElevationRad, kMaxElevationRad);
    return orbit;
}

void OrbitCamera::orbit(double dx, double dy) {
    azimuth_rad = std::remainder(azimuth_rad - kOrbitRadPerHeight * dx, 2.0 * kPi);
    elevation_rad =
        std::clamp(elevation_rad + kOrbitRadPerHeight * dy, -kMaxElevationRad, kMaxElevationRad);
}

void OrbitCamera::pan(double dx, double dy) {
    // What lies at the target stays under the pointer.
    const Camera current = camera();
    const double height = 2.0 * distance * std::tan(0.5 * double{current.vertical_fov_rad});
    const Eigen::Matrix3d axes = current.axes().cast<double>();
    target += height * (dy * axes.col(1) - dx * axes.col(0));
}

void OrbitCamera::zoom(double steps) {
    distance = std::clamp(distance * std::pow(kZoomPerStep, std::clamp(steps, -20.0, 20.0)),
                          framed_distance / kMaxZoom, framed_distance * kMaxZoom);
}

Camera OrbitCamera::camera(const Vec3d& origin) const {
    const Vec3d back(std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
                     std::cos(azimuth_rad) * std::cos(elevation_rad));
    Camera camera;
    camera.target = (origin + target).cast<float>();
    camera.eye = (origin + target + distance * back).cast<float>();
    return camera;
}

}  // namespace paim::player
