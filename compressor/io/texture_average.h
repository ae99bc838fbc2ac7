// The average colour of an image within a triangle of its coordinates.
#pragma once

#include <array>

#include "paim/base/vector.h"
#include "paim/image/mip_pyramid.h"

namespace paim {

struct TextureAverage {
    Vec3d color = Vec3d::Zero();  // linear, 0..1
    double area = 0.0;            // of the triangle, in images
};

// The triangle is divided into n² congruent ones, and the image is sampled at the centroid of each,
// at the level whose pixels have a quarter of its area. n is the longest edge in pixels, 1 to 8. A
// triangle without area is sampled along its line, and one that covers the image many times has the
// average of the image.
// corners  coordinates of an image that repeats, finite
TextureAverage average_of(const MipPyramid& image, const std::array<Vec2f, 3>& corners);

}  // namespace paim
