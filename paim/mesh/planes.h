// Points as planes x, y, z of V values each, which is how files and data matrices hold them.
#pragma once

#include <span>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

// [V] to [3][V].
std::vector<float> to_planes(std::span<const Vec3f> points);

// [3][V] to [V]; the size is a multiple of three (checked).
std::vector<Vec3f> from_planes(std::span<const float> planes);

}  // namespace paim
