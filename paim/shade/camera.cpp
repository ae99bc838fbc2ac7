// A pinhole camera.
#include "paim/shade/camera.h"

#include <algorithm>
#include <cmath>

namespace paim {

namespace {

// The axes right, up, backward of a camera in this direction from its target.
Eigen::Matrix3f axes_of(const Vec3f& direction, const Vec3f& up) {
    const Vec3f backward = direction.stableNormalized();
    const Vec3f right = up.cross(backward).normalized();
    Eigen::Matrix3f axes;
    axes << right, backward.cross(right), backward;
    return axes;
}

}  // namespace

Eigen::Matrix3f Camera::axes() const {
    return axes_of(eye - target, up);
}

Vec3f Camera::ray_direction(float u, float v, float aspect) const {
    const float half_height = std::tan(0.5f * vertical_fov_rad);
    const Vec3f local((2.0f * u - 1.0f) * half_height * aspect, (1.0f - 2.0f * v) * half_height,
                      -1.0f);
    return (axes() * local).normalized();
}

Camera frame_bounds(const Bounds& bounds, float aspect, float azimuth_rad, float elevation_rad) {
    constexpr float kMargin = 1.05f;
    Camera camera;
    const Vec3f direction(std::sin(azimuth_rad) * std::cos(elevation_rad), std::sin(elevation_rad),
                          std::cos(azimuth_rad) * std::cos(elevation_rad));
    camera.target = bounds.empty() ? Vec3f(Vec3f::Zero()) : bounds.center();
    if (bounds.diagonal() == 0.0f) {
        camera.eye = camera.target + direction;
        return camera;
    }
    // The nearest distance at which every corner of the box is inside the image.
    const Eigen::Matrix3f to_camera = axes_of(direction, camera.up).transpose();
    const Vec3f half = 0.5f * bounds.upper - 0.5f * bounds.lower;
    const float half_height = std::tan(0.5f * camera.vertical_fov_rad);
    float distance = 0.0f;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3f sign(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                         corner & 4 ? 1.0f : -1.0f);
        const Vec3f local = to_camera * half.cwiseProduct(sign);
        const float across = std::max(std::abs(local.x()) / aspect, std::abs(local.y()));
        distance = std::max(distance, local.z() + kMargin * across / half_height);
    }
    camera.eye = camera.target + direction * distance;
    return camera;
}

}  // namespace paim
