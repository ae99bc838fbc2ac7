// A light as the shading sees it: RGB spherical-harmonic coefficients of incident radiance at a
// place.
#pragma once

#include <vector>

#include "paim/base/vector.h"
#include "paim/sh/index.h"

namespace paim {

// Linear RGB radiance coefficients, i = l(l+1)+m.
struct LightCoefficients {
    int bands = 0;
    std::vector<Vec3f> values;  // [bands²]
};

class Light {
  public:
    virtual ~Light() = default;

    // Incident radiance at the position (scene units). Lights at infinity ignore the position.
    // bands 1 … sh::kMaxBands
    virtual LightCoefficients coefficients(const Vec3f& position, int bands) const = 0;
};

// Coefficients of the light turned about +Y by the angle, counter-clockwise seen from above (what
// --env-rotation means everywhere).
LightCoefficients turn_about_y(const LightCoefficients& light, double angle_rad);

}  // namespace paim
