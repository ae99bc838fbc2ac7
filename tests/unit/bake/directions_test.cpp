// Low-discrepancy points and cosine-distributed directions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "compressor/bake/cosine_directions.h"
#include "compressor/bake/sobol.h"
#include "paim/base/orthonormal_basis.h"
#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"

namespace paim {
namespace {

TEST(ScrambledSobol, EveryElementaryIntervalHoldsOnePoint) {
    // The defining property of a (0, m, 2)-net, which Owen scrambling keeps.
    constexpr uint32_t kLog = 8;
    const SobolPoints points(1u << kLog);
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

TEST(ScrambledSobol, SeedsGiveUniformIndependentPoints) {
    // One point under many seeds is uniform: mean 1/2, variance 1/12, no correlation of the axes.
    const SobolPoints points(16);
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
    const CosineDirections directions(200, 2);
    EXPECT_EQ(directions.count(), 100u);
    DirectionArrays d;
    RandomStream random(5);
    for (int j = 0; j < 200; ++j) {
        Vec3f normal = Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                           .normalized()
                           .cast<float>();
        if (j == 0) normal = Vec3f(0, 0, 1);
        if (j == 1) normal = Vec3f(0, 0, -1);
        directions.generate(normal, stream_key(1, 2, static_cast<uint64_t>(j)), j % 2, d);
        ASSERT_EQ(d.x.size(), 112u);
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
    const CosineDirections directions(1u << 14, 1);
    DirectionArrays d;
    directions.generate(normal, 99, 0, d);
    std::vector<double> y(36), mean(36, 0.0), at_normal(36);
    for (size_t j = 0; j < directions.count(); ++j) {
        sh::evaluate_basis(kBands, Vec3d(d.x[j], d.y[j], d.z[j]), std::span(y));
        for (size_t i = 0; i < 36; ++i) mean[i] += y[i] / directions.count();
    }
    sh::evaluate_basis(kBands, normal.cast<double>(), std::span(at_normal));
    for (int i = 0; i < 36; ++i) {
        // All points have the same place in their rings: errors are up to the largest value of y_i,
        // 1.6, divided by the number of points. Random points would give 8e-3.
        EXPECT_NEAR(mean[i], sh::cosine_lobe(sh::band_of(i)) * at_normal[i], 1e-4) << i;
    }
}

// Radii² and turns of all points of a set round the z axis, part by part.
std::vector<std::pair<double, double>> rings_and_turns(const CosineDirections& directions,
                                                       uint32_t num_parts, uint64_t key) {
    std::vector<std::pair<double, double>> points;
    DirectionArrays d;
    for (uint32_t part = 0; part < num_parts; ++part) {
        directions.generate(Vec3f(0, 0, 1), key, part, d);
        for (size_t j = 0; j < directions.count(); ++j) {
            const double x = d.x[j], y = d.y[j];
            points.emplace_back(x * x + y * y, std::atan2(y, x) / (2.0 * kPi));
        }
    }
    return points;
}

TEST(CosineDirections, AreOneInEachRingAndStepByTheSameTurn) {
    for (const uint32_t num_points : {2u, 6u, 64u, 514u}) {
        for (const uint32_t num_parts : {1u, 2u}) {
            const CosineDirections directions(num_points, num_parts);
            ASSERT_EQ(directions.count(), num_points / num_parts);
            auto points = rings_and_turns(directions, num_parts, 0x123456789abcdefu);
            std::sort(points.begin(), points.end());
            for (size_t j = 0; j < points.size(); ++j) {
                // Radii² are rounded to floats several times.
                EXPECT_NEAR(points[j].first - points[0].first, static_cast<double>(j) / num_points,
                            1e-6);
                EXPECT_LT(points[0].first, 1.0 / num_points + 1e-6);
                const double turns =
                    points[j].second - points[0].second - static_cast<double>(j) / std::sqrt(2.0);
                EXPECT_NEAR(turns, std::round(turns), 1e-4) << j;
            }
        }
    }
}

TEST(CosineDirections, KeysGiveUniformShiftsAndTurnsAndPartsChangePlaces) {
    const CosineDirections directions(8, 2);
    constexpr int kKeys = 4000;
    double shift = 0.0, turn_x = 0.0, turn_y = 0.0;
    int changed = 0;
    DirectionArrays d;
    const auto first_in_part = [&](uint64_t key) {
        directions.generate(Vec3f(0, 0, 1), key, 0, d);
        double least = 1.0;
        for (size_t j = 0; j < 4; ++j) {
            least = std::min(
                least, static_cast<double>(d.x[j]) * d.x[j] + static_cast<double>(d.y[j]) * d.y[j]);
        }
        return least < 1.0 / 8;
    };
    for (int k = 0; k < kKeys; ++k) {
        const uint64_t key = stream_key(1, 2, static_cast<uint64_t>(k));
        auto points = rings_and_turns(directions, 2, key);
        std::sort(points.begin(), points.end());
        shift += 8.0 * points[0].first / kKeys;
        turn_x += std::cos(2.0 * kPi * points[0].second) / kKeys;
        turn_y += std::sin(2.0 * kPi * points[0].second) / kKeys;
        changed += first_in_part(key) ? 1 : 0;
    }
    // Standard errors: √(1/12/N) = 0.0046, √(1/2/N) = 0.011 and √(N/4) = 32; four of each.
    EXPECT_NEAR(shift, 0.5, 0.019);
    EXPECT_NEAR(turn_x, 0.0, 0.045);
    EXPECT_NEAR(turn_y, 0.0, 0.045);
    EXPECT_NEAR(changed, kKeys / 2, 128);
}

TEST(CosineDirections, SixteenNeighboursAreCloseTogether) {
    const CosineDirections directions(512, 2);
    DirectionArrays d;
    directions.generate(Vec3f(0, 0, 1), stream_key(1, 2, 3), 0, d);
    double spread = 0.0;
    for (size_t first = 0; first < 256; first += 16) {
        Vec3d mean = Vec3d::Zero();
        for (size_t j = first; j < first + 16; ++j) mean += Vec3d(d.x[j], d.y[j], 0.0) / 16.0;
        for (size_t j = first; j < first + 16; ++j) {
            spread += (Vec3d(d.x[j], d.y[j], 0.0) - mean).squaredNorm() / 256.0;
        }
    }
    // A disk of a sixteenth of the area would have 1/2 · 1/16 = 0.031, all of the disk 0.5. Twice as
    // much is for shapes that are no disks; observed is 0.049.
    EXPECT_LT(spread, 0.0625);
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
