// Low-discrepancy points and cosine-distributed directions.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "compressor/bake/cosine_directions.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"

namespace paim {
namespace {

TEST(ScrambledSobol, EveryElementaryIntervalHoldsOnePoint) {
    // The defining property of a (0, m, 2)-net, which Owen scrambling keeps.
    constexpr uint32_t kLog = 8;
    const SobolPoints points(0, 1u << kLog);
    for (const uint32_t seed : {0u, 1u, 0xdeadbeefu}) {
        for (uint32_t log_x = 0; log_x <= kLog; ++log_x) {
            std::set<std::pair<int, int>> cells;
            for (uint32_t j = 0; j < (1u << kLog); ++j) {
                const float x = scrambled_fraction(points.reversed_x[j], seed);
                const float y = scrambled_fraction(points.reversed_y[j], seed * 3 + 1);
                cells.emplace(static_cast<int>(x * static_cast<float>(1u << log_x)),
                              static_cast<int>(y * static_cast<float>(1u << (kLog - log_x))));
            }
            EXPECT_EQ(cells.size(), size_t{1} << kLog) << seed << ' ' << log_x;
        }
    }
}

TEST(ScrambledSobol, SixteenNeighboursShareAnElementaryInterval) {
    // 256 points, 16 in each of the 4 x 4 squares, under any seed.
    const SobolPoints points(0, 256);
    for (const uint32_t seed : {0u, 1u, 0xdeadbeefu}) {
        for (size_t first = 0; first < 256; first += 16) {
            std::set<std::pair<int, int>> squares;
            for (size_t j = first; j < first + 16; ++j) {
                squares.emplace(
                    static_cast<int>(4.0f * scrambled_fraction(points.reversed_x[j], seed)),
                    static_cast<int>(4.0f * scrambled_fraction(points.reversed_y[j], seed + 1)));
            }
            EXPECT_EQ(squares.size(), 1u) << seed << ' ' << first;
        }
    }
}

TEST(ScrambledSobol, SeedsGiveUniformIndependentPoints) {
    // One point under many seeds is uniform: mean 1/2, variance 1/12, no correlation of the axes.
    const SobolPoints points(0, 16);
    constexpr int kSeeds = 20000;
    double mean = 0.0, square = 0.0, product = 0.0;
    for (int s = 0; s < kSeeds; ++s) {
        const uint64_t key = stream_key(1, 2, static_cast<uint64_t>(s));
        const double x = scrambled_fraction(points.reversed_x[5], static_cast<uint32_t>(key));
        const double y = scrambled_fraction(points.reversed_y[5], static_cast<uint32_t>(key >> 32));
        mean += x / kSeeds;
        square += (x - 0.5) * (x - 0.5) / kSeeds;
        product += (x - 0.5) * (y - 0.5) / kSeeds;
    }
    // Standard errors: √(1/12/N) = 0.0020, √(1/180/N) = 0.00053, 1/12/√N = 0.00059; four of each.
    EXPECT_NEAR(mean, 0.5, 0.0082);
    EXPECT_NEAR(square, 1.0 / 12, 0.0021);
    EXPECT_NEAR(product, 0.0, 0.0024);
}

TEST(CosineDirections, AreUnitAndAboveTheHorizon) {
    const CosineDirections directions(0, 100);
    EXPECT_EQ(directions.padded_count(), 112u);
    DirectionArrays d;
    RandomStream random(5);
    for (int j = 0; j < 200; ++j) {
        Vec3f normal = Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                           .normalized()
                           .cast<float>();
        if (j == 0) normal = Vec3f(0, 0, 1);
        if (j == 1) normal = Vec3f(0, 0, -1);
        directions.generate(normal, stream_key(1, 2, static_cast<uint64_t>(j)), d);
        for (size_t i = 0; i < 100; ++i) {
            const Vec3f w(d.x[i], d.y[i], d.z[i]);
            EXPECT_NEAR(w.norm(), 1.0f, 1e-6f);
            EXPECT_GE(w.dot(normal), -1e-6f);
        }
        EXPECT_EQ(d.x[100], 0.0f);
    }
}

TEST(CosineDirections, AverageTheBasisToTheCosineLobe) {
    // The mean of y_i over directions of density cos θ / π is â_l/π · y_i(n).
    constexpr int kBands = 6;
    const Vec3f normal = Vec3f(0.3f, -0.8f, 0.5f).normalized();
    const CosineDirections directions(0, 1u << 14);
    DirectionArrays d;
    directions.generate(normal, 99, d);
    std::vector<double> y(36), mean(36, 0.0), at_normal(36);
    for (size_t j = 0; j < directions.count(); ++j) {
        sh::evaluate_basis(kBands, Vec3d(d.x[j], d.y[j], d.z[j]), std::span(y));
        for (size_t i = 0; i < 36; ++i) mean[i] += y[i] / directions.count();
    }
    sh::evaluate_basis(kBands, normal.cast<double>(), std::span(at_normal));
    for (int i = 0; i < 36; ++i) {
        // Scrambled nets integrate smooth functions with error about N^-1.5 · log N: 5e-6 here; the
        // square root at the rim of the disk makes it worse. Random points would give 8e-3.
        EXPECT_NEAR(mean[i], sh::cosine_lobe(sh::band_of(i)) * at_normal[i], 1e-4) << i;
    }
}

TEST(OrthonormalBasis, IsRightHandedEverywhere) {
    for (const Vec3f& n :
         {Vec3f(0, 0, 1), Vec3f(0, 0, -1), Vec3f(1, 0, 0), Vec3f(0.6f, 0, -0.8f)}) {
        Vec3f t, b;
        orthonormal_basis(n, t, b);
        EXPECT_NEAR((t.cross(b) - n).norm(), 0.0f, 1e-6f);
        EXPECT_NEAR(t.dot(b), 0.0f, 1e-6f);
    }
}

}  // namespace
}  // namespace paim
