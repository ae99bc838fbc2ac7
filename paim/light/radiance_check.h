// Whether the pixels of a map are radiance.
#pragma once

#include <span>

#include "paim/base/vector.h"

namespace paim {

// Looks at pixels as they arrive.
class RadianceCheck {
  public:
    // Pixels of row y from column x on.
    // weight  ∝ the solid angle of each
    // Error (bad input), naming the pixel, if a value is not finite.
    void add(int x, int y, std::span<const Vec3f> pixels, double weight);

    // After all pixels. Error (bad input), naming the worst pixel, if values below zero sum to more
    // than 5 % of those above. Lossy compression leaves smaller ones around bright lights.
    void finish() const;

  private:
    double positive_ = 0.0;
    double negative_ = 0.0;
    float worst_ = 0.0f;
    int worst_x_ = 0;
    int worst_y_ = 0;
};

}  // namespace paim
