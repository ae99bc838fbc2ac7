// The slow reference against polynomials from the literature, the addition theorem and
// orthonormality.
#include "paim/sh/basis_reference.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/sh/index.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

TEST(BasisReference, IsThePolynomialsOfTheFirstThreeBands) {
    for (const Vec3d& d : test_directions()) {
        const auto [x, y, z] = std::tuple(d.x(), d.y(), d.z());
        const double expected[9] = {
            std::sqrt(1.0 / (4.0 * kPi)),
            std::sqrt(3.0 / (4.0 * kPi)) * y,
            std::sqrt(3.0 / (4.0 * kPi)) * z,
            std::sqrt(3.0 / (4.0 * kPi)) * x,
            std::sqrt(15.0 / (4.0 * kPi)) * x * y,
            std::sqrt(15.0 / (4.0 * kPi)) * y * z,
            std::sqrt(5.0 / (16.0 * kPi)) * (3.0 * z * z - 1.0),
            std::sqrt(15.0 / (4.0 * kPi)) * x * z,
            std::sqrt(15.0 / (16.0 * kPi)) * (x * x - y * y),
        };
        for (int i = 0; i < 9; ++i) {
            const int l = band_of(i);
            // A few roundings of values below 1.
            EXPECT_NEAR(basis_reference(l, i - index(l, 0), d), expected[i], 1e-15) << i;
        }
    }
}

TEST(BasisReference, ObeysTheAdditionTheorem) {
    // Σ_m y_lm(a) y_lm(b) = (2l+1)/4π P_l(a·b); with a = b, P_l = 1.
    for (const Vec3d& d : test_directions()) {
        for (int l = 0; l < kMaxBands; ++l) {
            double sum = 0.0;
            for (int m = -l; m <= l; ++m) {
                const double y = basis_reference(l, m, d);
                sum += y * y;
            }
            const double expected = (2.0 * l + 1.0) / (4.0 * kPi);
            // 2l+1 squares, each rounded to 2^-53.
            EXPECT_NEAR(sum / expected, 1.0, 1e-15 * (2.0 * l + 1.0)) << l;
        }
    }
}

TEST(BasisReference, HasNoCondonShortleyPhase) {
    EXPECT_NEAR(basis_reference(1, -1, Vec3d::UnitY()), 0.488603, 1e-6);
    EXPECT_NEAR(basis_reference(1, 0, Vec3d::UnitZ()), 0.488603, 1e-6);
    EXPECT_NEAR(basis_reference(1, 1, Vec3d::UnitX()), 0.488603, 1e-6);
}

}  // namespace
}  // namespace paim::sh
