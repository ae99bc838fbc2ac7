// Directions in proportion to the light of an environment map.
// Based on: Pharr and Humphreys, Physically Based Rendering, 2nd edition, 2010, section 14.6.5
//           (infinite area lights)
#pragma once

#include <cstdint>
#include <vector>

#include "paim/base/vector.h"
#include "paim/light/environment.h"

namespace paim {

// Samples a lat-long map whose pixels are areas of constant radiance (docs/conventions.md). The
// density of a direction is in proportion to the largest absolute channel of its pixel.
class LightSampler {
  public:
    explicit LightSampler(const EnvironmentLight& light);

    // Nothing can be sampled; all densities are 0.
    bool is_black() const { return total_ <= 0.0; }

    struct Sample {
        Vec3f direction;  // unit
        Vec3f radiance;
        float density;  // per steradian
    };

    // The direction of random numbers u and v in [0, 1). The map is not black (checked).
    Sample sample(double u, double v) const;

    // The pixel that is seen in this unit direction.
    Sample look(const Vec3f& direction) const;

  private:
    Sample pixel(int x, int y, const Vec3f& direction) const;

    EnvironmentLight light_;
    // Sums of weight over rows, and within each row over pixels: [height + 1], [height][width + 1].
    std::vector<double> rows_, pixels_;
    double total_ = 0.0;  // ∫ largest absolute channel dω
};

}  // namespace paim
