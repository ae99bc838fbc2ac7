// Sixteen directions at once against the slow reference, and the independence of lanes.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paim/sh/basis.h"
#include "paim/sh/basis_reference.h"
#include "tests/unit/sh/directions.h"

namespace paim::sh {
namespace {

constexpr int kBatch = BatchBasis::kBatch;

struct Lanes {
    float x[kBatch], y[kBatch], z[kBatch];
    void set(int j, const Vec3d& d) {
        x[j] = static_cast<float>(d.x());
        y[j] = static_cast<float>(d.y());
        z[j] = static_cast<float>(d.z());
    }
};

// Largest error of a value of band l, relative to the largest value of the band and to the
// direction before it was rounded to float.
double tolerance(int bands, int l) {
    const double steps = 0.5 * l * (l + 1.0);
    // To 16 bands: half a rounding of z, 2^-25, times y_l0's slope l(l+1)/2 next to a pole, twice
    // for those of the recurrence; 8 roundings are everything else.
    if (bands <= 16) return 0x1.0p-24 * (8.0 + steps);
    // Above, in double: each coordinate's rounding, 2^-25, turns the direction by √3 · 2^-25 at
    // most. No function of the band is steeper than sqrt(l(l+1)/2), as the squares of all slopes
    // sum to l(l+1)/2 in each tangent direction. Then the result is rounded once.
    return 0x1.0p-25 * std::sqrt(3.0 * steps) + 0x1.0p-24 * 1.001;
}

class BatchBasisOfBands : public testing::TestWithParam<int> {};

TEST_P(BatchBasisOfBands, AgreesWithTheReference) {
    const int bands = GetParam();
    const BatchBasis basis(bands);
    std::vector<float> values(static_cast<size_t>(num_coefficients(bands) * kBatch));
    const std::vector<Vec3d> directions = test_directions();
    for (size_t first = 0; first < directions.size(); first += kBatch) {
        Lanes lanes{};
        for (int j = 0; j < kBatch; ++j) lanes.set(j, directions[first + static_cast<size_t>(j)]);
        basis.evaluate(lanes.x, lanes.y, lanes.z, values.data());
        for (int j = 0; j < kBatch; ++j) {
            const Vec3d& d = directions[first + static_cast<size_t>(j)];
            for (int l = 0; l < bands; ++l) {
                // What is promised, from 1 to 64 bands.
                ASSERT_LE(tolerance(bands, l), 1e-5);
                for (int m = -l; m <= l; ++m) {
                    ASSERT_NEAR(values[static_cast<size_t>(index(l, m) * kBatch + j)],
                                basis_reference(l, m, d), tolerance(bands, l) * band_maximum(l))
                        << l << " " << m << " at " << d.transpose();
                }
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Bands, BatchBasisOfBands,
                         testing::Values(1, 2, 3, 5, 7, 10, 16, 17, 32, 64));

TEST(BatchBasis, LanesDoNotTouchOneAnother) {
    const BatchBasis basis(6);
    const std::vector<Vec3d> directions = test_directions();
    Lanes mixed{};
    for (int j = 0; j < kBatch; ++j) mixed.set(j, directions[static_cast<size_t>(j)]);
    std::vector<float> all(36 * kBatch), one(36 * kBatch);
    basis.evaluate(mixed.x, mixed.y, mixed.z, all.data());
    for (int j = 0; j < kBatch; ++j) {
        Lanes same{};
        for (int k = 0; k < kBatch; ++k) same.set(k, directions[static_cast<size_t>(j)]);
        basis.evaluate(same.x, same.y, same.z, one.data());
        for (size_t i = 0; i < 36; ++i) {
            EXPECT_EQ(one[i * kBatch], all[i * kBatch + static_cast<size_t>(j)]);
        }
    }
}

TEST_P(BatchBasisOfBands, AccumulatesWeightedValues) {
    const int bands = GetParam();
    const BatchBasis basis(bands);
    const auto num_values = static_cast<size_t>(num_coefficients(bands));
    const std::vector<Vec3d> directions = test_directions();
    Lanes lanes{};
    float weights[kBatch];
    for (int j = 0; j < kBatch; ++j) {
        lanes.set(j, directions[static_cast<size_t>(j) * 5 % directions.size()]);
        weights[j] = static_cast<float>(0.3 * j - 2.0);
    }
    std::vector<float> values(num_values * kBatch);
    std::vector<float> sums(num_values * BatchBasis::kSumLanes, 1.0f);  // it adds to what is there
    basis.evaluate(lanes.x, lanes.y, lanes.z, values.data());
    basis.accumulate(lanes.x, lanes.y, lanes.z, weights, sums.data());
    for (int l = 0; l < bands; ++l) {
        for (int m = -l; m <= l; ++m) {
            const auto i = static_cast<size_t>(index(l, m));
            double expected = BatchBasis::kSumLanes;
            double sum = 0.0;
            for (size_t j = 0; j < kBatch; ++j) {
                expected += static_cast<double>(weights[j]) * values[i * kBatch + j];
            }
            for (size_t j = 0; j < BatchBasis::kSumLanes; ++j)
                sum += sums[i * BatchBasis::kSumLanes + j];
            // Sixteen weights of at most 2.5, each value's recurrence as above (in double only
            // values[] is rounded, by less), and the sums' own roundings.
            const double error =
                16 * 2.5 * tolerance(bands, l) * band_maximum(l) + 0x1.0p-24 * 16.0;
            ASSERT_NEAR(sum, expected, error) << l << " " << m;
        }
    }
}

TEST(BatchBasis, LengthDoesNotMatterAboveSixteenBands) {
    // A float's rounding leaves the sphere: what is off along the direction must not count. Zero,
    // with which callers may pad, gives finite values.
    const BatchBasis basis(64);
    Lanes lanes{}, longer{};
    for (int j = 1; j < kBatch; ++j) {
        const Vec3d d = Vec3d(1e-3 * j, -2e-3, 1.0).normalized();
        lanes.set(j, d);
        longer.set(j, 4.0 * d);  // the same floats, scaled exactly
    }
    std::vector<float> a(4096 * kBatch), b(4096 * kBatch);
    basis.evaluate(lanes.x, lanes.y, lanes.z, a.data());
    basis.evaluate(longer.x, longer.y, longer.z, b.data());
    EXPECT_EQ(a, b);
    for (size_t i = 0; i < 4096; ++i) ASSERT_TRUE(std::isfinite(a[i * kBatch])) << i;
}

TEST(BatchBasisDeathTest, RefusesTooManyBands) {
    EXPECT_DEATH(BatchBasis(65), "check failed.*bands");
    EXPECT_DEATH(BatchBasis(0), "check failed.*bands");
}

}  // namespace
}  // namespace paim::sh
