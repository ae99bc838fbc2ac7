// RGB images of linear radiance.
#pragma once

#include <cstddef>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/vector.h"

namespace paim {

// An image of linear RGB radiance. Row 0 is the top row.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Vec3f> pixels;  // [height · width], row-major

    Image() = default;
    Image(int width_pixels, int height_pixels, const Vec3f& fill = Vec3f::Zero())
        : width(width_pixels),
          height(height_pixels),
          pixels(static_cast<size_t>(width_pixels) * static_cast<size_t>(height_pixels), fill) {}

    Vec3f& at(int x, int y) { return pixels[offset(x, y)]; }
    const Vec3f& at(int x, int y) const { return pixels[offset(x, y)]; }

  private:
    size_t offset(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    }
};

// Averages factor × factor blocks; width and height must be multiples of the factor.
Image downsample(const Image& image, int factor);

}  // namespace paim
