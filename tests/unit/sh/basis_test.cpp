// The fast basis against the slow reference, to the largest band and next to the poles;
// orthonormality.
#include "paim/sh/basis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paim/base/gauss_legendre.h"
#include "paim/sh/basis_reference.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

// 2^-53 · l(l+1)/2 is what a rounding of z does to y_l0 next to a pole; the recurrence does so a
// few times over. 8 roundings are everything else.
double double_tolerance(int l) {
    return 0x1.0p-53 * (8.0 + 2.0 * l * (l + 1.0));
}

TEST(Basis, AgreesWithTheReference) {
    std::vector<double> doubles(64 * 64);
    std::vector<float> floats(64 * 64);
    for (const Vec3d& d : test_directions()) {
        evaluate_basis(64, d, doubles);
        evaluate_basis(64, d, floats);
        for (int l = 0; l < 64; ++l) {
            for (int m = -l; m <= l; ++m) {
                const auto i = static_cast<size_t>(index(l, m));
                const double expected = basis_reference(l, m, d);
                ASSERT_NEAR(doubles[i], expected, double_tolerance(l) * band_maximum(l))
                    << l << " " << m << " at " << d.transpose();
                // One rounding to float.
                ASSERT_NEAR(floats[i], expected, 0x1.0p-24 * 1.001 * band_maximum(l));
            }
        }
    }
}

TEST(Basis, FewerBandsAreThePrefix) {
    const Vec3d d = Vec3d(0.3, -0.5, 0.2).normalized();
    std::vector<double> all(64 * 64);
    evaluate_basis(64, d, all);
    for (int bands = 1; bands < 64; ++bands) {
        std::vector<double> some(static_cast<size_t>(num_coefficients(bands)));
        evaluate_basis(bands, d, some);
        EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin())) << bands;
    }
}

TEST(Basis, DoesNotDependOnLength) {
    const Vec3d d(1e-3, 2e-3, 0.999997);
    std::vector<double> a(64 * 64), b(64 * 64);
    evaluate_basis(64, d, a);
    evaluate_basis(64, Vec3d(1.0001 * d), b);
    for (size_t i = 0; i < a.size(); ++i) {
        const int l = band_of(static_cast<int>(i));
        EXPECT_NEAR(a[i], b[i], double_tolerance(l) * band_maximum(l));
    }
}

TEST(Basis, IsOrthonormal) {
    // Products of two functions below band 16 have degree 30 at most: 16 Gauss–Legendre latitudes
    // and 31 equidistant longitudes integrate them exactly, up to rounding.
    constexpr int kBands = 16;
    constexpr int kCoefficients = kBands * kBands;
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(kCoefficients, kCoefficients);
    std::vector<double> values(kCoefficients);
    const Eigen::Map<const Eigen::VectorXd> y(values.data(), kCoefficients);
    for (const auto& [z, weight] : gauss_legendre(kBands, -1.0, 1.0)) {
        const double s = std::sqrt(1.0 - z * z);
        for (int k = 0; k < 31; ++k) {
            const double phi = 2.0 * kPi * k / 31.0;
            evaluate_basis(kBands, Vec3d(s * std::cos(phi), s * std::sin(phi), z), values);
            gram += weight * (2.0 * kPi / 31.0) * y * y.transpose();
        }
    }
    const Eigen::MatrixXd error = gram - Eigen::MatrixXd::Identity(kCoefficients, kCoefficients);
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-13);
}

TEST(BasisDeathTest, RefusesWrongSizes) {
    std::vector<float> values(9);
    EXPECT_DEATH(evaluate_basis(4, Vec3d::UnitZ(), values), "check failed.*size");
    EXPECT_DEATH(evaluate_basis(0, Vec3d::UnitZ(), std::span<float>()), "check failed.*bands");
    EXPECT_DEATH(evaluate_basis(65, Vec3d::UnitZ(), values), "check failed.*bands");
}

}  // namespace
}  // namespace paim::sh
