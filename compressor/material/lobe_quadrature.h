// Integrals over the directions that a BRDF reflects light to.
#pragma once

#include <vector>

#include "compressor/material/brdf.h"
#include "paim/base/gauss_legendre.h"

namespace paim {

// Points and weights for light from one direction.
// Based on: composite Gauss–Legendre quadrature in polar coordinates about the mirror direction (Davis
//           and Rabinowitz, Methods of Numerical Integration, 1984, section 2.9)
//
// The radius ends exactly at the horizon. Panels are half as wide as their neighbour towards the
// middle of the lobe, towards the horizon, and towards the planes along and across the plane of
// incidence, where lobes at grazing angles change fast.
class LobeQuadrature {
  public:
    struct Point {
        Vec3d direction;  // unit, above the surface, with y > 0
        double value;     // of the BRDF
        double weight;    // solid angle, also of the mirror image at the plane of incidence
    };

    explicit LobeQuadrature(const Brdf& brdf);

    // The points of the upper hemisphere that matter for light from (√(1 − cosine²), 0, cosine), so
    // that ∫ value(v) g(v) dv ≈ Σ weight · value · g for a g that is the same at (x, ±y, z).
    // cosine  0 … 1
    // err     relative to ∫ value(v) dv: 1e-6 for g of at most 8 bands, measured for exponents of
    //         Phong up to 10,000 and roughness from 0.02
    void points(double cosine, std::vector<Point>& out) const;

  private:
    const Brdf& brdf_;
    const double width_;
    std::vector<QuadratureNode> radial_, around_;  // on 0 … 1
};

}  // namespace paim
