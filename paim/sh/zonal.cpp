// Rotates zonal functions, and computes the coefficients of a cone.
#include "paim/sh/zonal.h"

#include <cmath>

#include "paim/base/check.h"
#include "paim/sh/basis.h"
#include "paim/sh/index.h"

namespace paim::sh {

std::vector<double> zonal_to_axis(std::span<const double> zonal, const Vec3d& axis) {
    const int bands = static_cast<int>(zonal.size());
    std::vector<double> values(static_cast<size_t>(num_coefficients(bands)));
    evaluate_basis(bands, axis, values);
    for (int l = 0; l < bands; ++l) {
        const double scale = std::sqrt(4.0 * kPi / (2.0 * l + 1.0)) * zonal[static_cast<size_t>(l)];
        for (int m = -l; m <= l; ++m) values[static_cast<size_t>(index(l, m))] *= scale;
    }
    return values;
}

std::vector<double> cone_zonal(int bands, double half_angle_rad) {
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, kMaxBands);
    PAIM_CHECK(half_angle_rad >= 0.0 && half_angle_rad <= kPi);
    std::vector<double> zonal(static_cast<size_t>(bands));
    const double sin_half = std::sin(0.5 * half_angle_rad);
    zonal[0] = std::sqrt(kPi) * 2.0 * sin_half * sin_half;
    // With c = cos α: ∫_c^1 P_l = (P_{l-1} − P_{l+1}) / (2l+1) = sin² α P_l'(c) / (l (l+1)); the
    // last form does not cancel for narrow cones.
    const double c = std::cos(half_angle_rad);
    const double sin2 = std::sin(half_angle_rad) * std::sin(half_angle_rad);
    double legendre = c;        // P_l
    double before = 1.0;        // P_{l-1}
    double slope = 1.0;         // P_l'
    double slope_before = 0.0;  // P_{l-1}'
    for (int l = 1; l < bands; ++l) {
        zonal[static_cast<size_t>(l)] =
            std::sqrt(kPi * (2.0 * l + 1.0)) * sin2 * slope / (static_cast<double>(l) * (l + 1));
        const double next = ((2.0 * l + 1.0) * c * legendre - l * before) / (l + 1.0);
        const double next_slope = slope_before + (2.0 * l + 1.0) * legendre;
        before = legendre;
        legendre = next;
        slope_before = slope;
        slope = next_slope;
    }
    return zonal;
}

}  // namespace paim::sh
