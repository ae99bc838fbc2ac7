// The small vectors that all folders share.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>

namespace paim {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;

static_assert(sizeof(Vec3f) == 12,
              "arrays of Vec3f are handed to Embree, OpenGL and files as they are");

constexpr double kPi = 3.14159265358979323846;

}  // namespace paim
