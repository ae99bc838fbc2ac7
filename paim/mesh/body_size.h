// The middle and the size of a body, which outliers do not change.
#pragma once

#include <span>

#include "paim/base/vector.h"

namespace paim {

// The median of points, each coordinate by itself. At least one point.
Vec3d median_point(std::span<const Vec3d> points);

// About the diagonal of a body: four times the median distance from the median point. At least one
// point.
double size_of(std::span<const Vec3d> points);

}  // namespace paim
