// The cosine lobe against known values, quadrature and its own sum.
#include "paim/sh/cosine_lobe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/base/gauss_legendre.h"
#include "paim/base/vector.h"
#include "paim/sh/index.h"

namespace paim::sh {
namespace {

double legendre(int l, double z) {
    double before = 0.0, current = 1.0;
    for (int k = 1; k <= l; ++k) {
        const double next = ((2.0 * k - 1.0) * z * current - (k - 1.0) * before) / k;
        before = current;
        current = next;
    }
    return current;
}

TEST(CosineLobe, HasTheKnownFirstValues) {
    EXPECT_DOUBLE_EQ(cosine_lobe(0), 1.0);
    EXPECT_DOUBLE_EQ(cosine_lobe(1), 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(cosine_lobe(2), 1.0 / 4.0);
    EXPECT_EQ(cosine_lobe(3), 0.0);
    EXPECT_DOUBLE_EQ(cosine_lobe(4), -1.0 / 24.0);
    EXPECT_DOUBLE_EQ(cosine_lobe(6), 1.0 / 64.0);
}

TEST(CosineLobe, IsTheIntegral) {
    // P_l(z) z has degree 64 at most, which 33 nodes integrate exactly; what is left is rounding.
    const auto nodes = gauss_legendre(33, 0.0, 1.0);
    for (int l = 0; l < kMaxBands; ++l) {
        double sum = 0.0;
        for (const auto& [z, weight] : nodes) sum += weight * legendre(l, z) * z;
        EXPECT_NEAR(cosine_lobe(l), 2.0 * sum, 1e-14) << l;
    }
}

TEST(CosineLobe, SumsToTheLobe) {
    // max(0, z)/π = Σ_l (2l+1)/4π · cosine_lobe(l) P_l(z). Terms fall as l^-1.5 · l^-0.5 away from
    // the ends, so that 64 bands are right to a few 1e-3 of the peak.
    for (const double z : {-0.8, -0.3, 0.0, 0.4, 0.9}) {
        double sum = 0.0;
        for (int l = 0; l < kMaxBands; ++l) {
            sum += (2.0 * l + 1.0) / (4.0 * kPi) * cosine_lobe(l) * legendre(l, z);
        }
        EXPECT_NEAR(sum, std::max(0.0, z) / kPi, 3e-3) << z;
    }
}

TEST(CosineLobeDeathTest, RefusesBandsBeyondTheLargest) {
    EXPECT_DEATH(cosine_lobe(-1), "check failed");
    EXPECT_DEATH(cosine_lobe(kMaxBands), "check failed");
}

}  // namespace
}  // namespace paim::sh
