// The basis from unnormalised associated Legendre functions by their textbook recurrence, a
// normalisation by factorials, and cos and sin of the azimuth. It shares nothing with basis.cpp.
// Long double holds the 125!! ≈ 1e104 of 64 bands, and has three digits more than double.
// Based on: Robin Green, Spherical Harmonic Lighting: The Gritty Details, 2003 (without the phase
//           (−1)^m)
#include "paim/sh/basis_reference.h"

#include <cmath>
#include <cstdlib>

#include "paim/base/check.h"
#include "paim/sh/index.h"

namespace paim::sh {

namespace {

// P_l^m(cos θ) without the phase, m >= 0.
long double legendre(int l, int m, long double cos_theta, long double sin_theta) {
    long double p_mm = 1.0L;
    for (int k = 1; k <= m; ++k) p_mm *= (2 * k - 1) * sin_theta;
    if (l == m) return p_mm;
    long double before = p_mm;
    long double current = (2 * m + 1) * cos_theta * p_mm;
    for (int k = m + 2; k <= l; ++k) {
        const long double next =
            ((2 * k - 1) * cos_theta * current - (k + m - 1) * before) / (k - m);
        before = current;
        current = next;
    }
    return current;
}

// sqrt((2l+1)/4π · (l−m)!/(l+m)!)
long double normalisation(int l, int m) {
    long double ratio = 1.0L;
    for (int k = l - m + 1; k <= l + m; ++k) ratio /= k;
    const long double pi = std::acos(-1.0L);
    return std::sqrt((2 * l + 1) / (4.0L * pi) * ratio);
}

}  // namespace

double basis_reference(int l, int m, const Vec3d& direction) {
    PAIM_CHECK(0 <= l && l < kMaxBands);
    PAIM_CHECK_LE(std::abs(m), l);
    const long double x = direction.x();
    const long double y = direction.y();
    const long double z = direction.z();
    const long double sin_radius = std::hypot(x, y);
    const long double radius = std::hypot(sin_radius, z);
    const long double phi = std::atan2(y, x);
    const int order = std::abs(m);
    const long double zonal =
        normalisation(l, order) * legendre(l, order, z / radius, sin_radius / radius);
    if (m == 0) return static_cast<double>(zonal);
    const long double azimuth = m > 0 ? std::cos(order * phi) : std::sin(order * phi);
    return static_cast<double>(std::sqrt(2.0L) * zonal * azimuth);
}

}  // namespace paim::sh
