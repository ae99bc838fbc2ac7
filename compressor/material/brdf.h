// Isotropic reflection at a surface. Directions are in its frame, whose z axis is the normal; they
// point away from the surface.
#pragma once

#include <string>

#include "paim/base/vector.h"

namespace paim {

class Brdf {
  public:
    virtual ~Brdf() = default;

    // What parse_brdf() (brdfs.h) makes this BRDF of, in its shortest form: "phong:0.5,32".
    virtual std::string text() const = 0;

    // Reflected radiance for each unit of irradiance from `in` (1/sr), without the cosine of `in`.
    // It is not negative, and the same with both directions exchanged. It is the same if both turn
    // about the normal, or are mirrored at a plane through it. 0 unless both are above the surface.
    // in, out  unit
    virtual double value(const Vec3d& in, const Vec3d& out) const = 0;

    // A direction of light that leaves towards `out`, distributed with density pdf(direction, out)
    // over the sphere; it may be below the surface.
    // out   unit, above the surface
    // u, v  0 … 1, uniform
    virtual Vec3d sample(const Vec3d& out, double u, double v) const = 0;
    virtual double pdf(const Vec3d& in, const Vec3d& out) const = 0;  // 1/sr

    // About the angle from the middle of the lobe to half of its value, at normal incidence.
    virtual double half_width_rad() const = 0;
};

}  // namespace paim
