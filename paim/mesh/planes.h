// Points as planes x, y, z of V values each, which is how files and data matrices hold them.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// [V] to [3][V].
std::vector<float> to_planes(std::span<const Vec3f> points);

// [3][V] to [3][R]: those of these points, R of them; of all, if there are none.
std::vector<float> planes_at(std::span<const float> planes, std::span<const uint32_t> points);

// [3][V] to [V]; the size is a multiple of three (checked).
std::vector<Vec3f> from_planes(std::span<const float> planes);

// Turns the first `num_points` points of [3][V] in place, in double, and adds `shift` to them; all if
// there are fewer. Coordinates beyond the range of floats, as outliers may have, become its ends.
void transform_planes(const Eigen::Matrix3d& rotation, const Vec3d& shift, std::span<float> planes,
                      size_t num_points = std::numeric_limits<size_t>::max());

}  // namespace paim
