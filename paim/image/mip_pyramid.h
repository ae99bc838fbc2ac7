// An image at all the sizes at which it is drawn: each level is half of the one before, averaged in
// linear light.
// Based on: Lance Williams, Pyramidal Parametrics, 1983
#pragma once

#include <vector>

#include "paim/base/vector.h"
#include "paim/image/texture_image.h"

namespace paim {

class MipPyramid {
  public:
    // Level 0 is the image. Sizes are halved, rounded down, until both are 1, as OpenGL wants them.
    // Each pixel is the mean of the area that it covers of the level before, also where a size is
    // odd. Means are taken in linear light and are rounded to 8-bit sRGB once.
    // image  at least 1 × 1 (checked)
    explicit MipPyramid(DecodedTexture image);

    const std::vector<DecodedTexture>& levels() const { return levels_; }

    // The colour of a place, linear, 0..1: bilinear within the two levels next to `level`, and
    // between them. The image repeats.
    // u, v   finite; u grows to the right and v upwards, 0..1 is the whole image
    // level  any number, clamped to the levels that there are
    Vec3f sample(float u, float v, float level) const;

    // The level at which a pixel of a picture is about as large as one of the image: log2 of the
    // longer of the steps from one pixel to the next.
    // Based on: The OpenGL 4.6 Specification, section 8.14.1
    // per_x, per_y  change of (u, v) from one pixel of the picture to the next
    // returns       below 0 where the image is enlarged
    float level(const Vec2f& per_x, const Vec2f& per_y) const;

  private:
    std::vector<DecodedTexture> levels_;
};

}  // namespace paim
