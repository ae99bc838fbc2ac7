// Cones against quadrature and their limits; turned zonal functions against their values.
#include "paim/sh/zonal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "paim/base/gauss_legendre.h"
#include "paim/sh/basis.h"
#include "paim/sh/basis_reference.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

TEST(ConeZonal, IsTheIntegralOverTheCone) {
    // ∫ y_l0 over the cone = 2π ∫ y_l0(z) dz over [cos α, 1], a polynomial of degree 63 at most:
    // exact with 32 nodes, up to the rounding of values below 3.2 over an area of 4π.
    for (const double angle : {0.1, 0.7, kPi / 2.0, 2.5, kPi}) {
        const std::vector<double> zonal = cone_zonal(kMaxBands, angle);
        const auto nodes = gauss_legendre(32, std::cos(angle), 1.0);
        for (int l = 0; l < kMaxBands; ++l) {
            double sum = 0.0;
            for (const auto& [z, weight] : nodes) {
                sum += weight * basis_reference(l, 0, Vec3d(std::sqrt(1.0 - z * z), 0.0, z));
            }
            EXPECT_NEAR(zonal[static_cast<size_t>(l)], 2.0 * kPi * sum, 2e-13) << l << " " << angle;
        }
    }
}

TEST(ConeZonal, NarrowConesArePoints) {
    // As α → 0 the cone is its solid angle times y_l0 at the pole, to (l α)²/8 relative.
    const double angle = 1e-7;
    const std::vector<double> zonal = cone_zonal(kMaxBands, angle);
    for (int l = 0; l < kMaxBands; ++l) {
        EXPECT_NEAR(zonal[static_cast<size_t>(l)] / (kPi * angle * angle * band_maximum(l)), 1.0,
                    1e-11)
            << l;
    }
}

TEST(ConeZonal, TheWholeSphereIsConstant) {
    const std::vector<double> zonal = cone_zonal(kMaxBands, kPi);
    EXPECT_NEAR(zonal[0], std::sqrt(4.0 * kPi), 1e-15);
    // sin² π is 1e-32.
    for (size_t l = 1; l < zonal.size(); ++l) EXPECT_NEAR(zonal[l], 0.0, 1e-25);
}

TEST(ZonalToAxis, KeepsTheValueAroundTheAxis) {
    // The turned function at ω is Σ_l zonal_l y_l0 at the angle between ω and the axis.
    const std::vector<double> zonal = cone_zonal(20, 0.6);
    std::vector<double> basis(400);
    RandomStream random(stream_key(3, 1, 4));
    for (int trial = 0; trial < 50; ++trial) {
        const Vec3d axis = random_direction(random);
        const Vec3d direction = random_direction(random);
        const std::vector<double> turned = zonal_to_axis(zonal, axis);
        evaluate_basis(20, direction, basis);
        double value = 0.0;
        for (size_t i = 0; i < 400; ++i) value += turned[i] * basis[i];
        const double c = std::clamp(axis.dot(direction), -1.0, 1.0);
        const Vec3d same_angle(std::sqrt(1.0 - c * c), 0.0, c);
        double expected = 0.0;
        for (int l = 0; l < 20; ++l) {
            expected += zonal[static_cast<size_t>(l)] * basis_reference(l, 0, same_angle);
        }
        // 400 terms below 1, and the rounding of c, 2^-53, times the slope 20² of P_19.
        EXPECT_NEAR(value, expected, 1e-12);
    }
}

TEST(ZonalToAxis, OfThePoleIsTheZonalItself) {
    const std::vector<double> zonal{1.0, 2.0, 3.0};
    const std::vector<double> turned = zonal_to_axis(zonal, Vec3d::UnitZ());
    for (int i = 0; i < 9; ++i) {
        const int l = band_of(i);
        const double expected = i == index(l, 0) ? zonal[static_cast<size_t>(l)] : 0.0;
        EXPECT_NEAR(turned[static_cast<size_t>(i)], expected, 1e-14);
    }
}

TEST(ConeZonalDeathTest, RefusesImpossibleAngles) {
    EXPECT_DEATH(cone_zonal(3, -0.1), "check failed");
    EXPECT_DEATH(cone_zonal(3, 3.2), "check failed");
}

}  // namespace
}  // namespace paim::sh
