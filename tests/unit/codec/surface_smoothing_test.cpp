// Smoothing within rounding: closed forms, what stays in its place, and the gain on a smooth plane.
#include "paim/codec/surface_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

const Topology kTriangle{4, {{0, 1, 2}}};  // and a vertex of no face

double rms_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t j = 0; j < a.size(); ++j) sum += std::pow(double{a[j]} - double{b[j]}, 2.0);
    return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST(SurfaceSmoother, MovesHalfOfTheWayToTheMeanWithinReach) {
    const SurfaceSmoother smoother(kTriangle);
    const std::vector<float> stored{0.0f, 1.0f, 1.0f, 7.0f};
    std::vector<float> values = stored;
    smoother.smooth(stored, 1, 0.4375f, values);
    // Means of neighbours: 1, 1/2, 1/2.
    EXPECT_EQ(values, (std::vector<float>{0.4375f, 0.75f, 0.75f, 7.0f}));
    smoother.smooth(stored, 1, 0.4375f, values);
    EXPECT_EQ(values, (std::vector<float>{0.4375f, 0.671875f, 0.671875f, 7.0f}));
    std::vector<float> at_once = stored;
    smoother.smooth(stored, 2, 0.4375f, at_once);
    EXPECT_EQ(at_once, values);
}

// The error of rounding is 1 / √12 of a step. A quarter of it is left where 20 values share one
// integer.
TEST(SurfaceSmoother, LeavesLittleErrorOnASmoothSurface) {
    constexpr uint32_t kWidth = 60;
    const std::vector<float> exact = paraboloid(kWidth);
    std::vector<float> stored = exact;
    for (float& value : stored) value = std::nearbyint(value);
    EXPECT_NEAR(rms_difference(stored, exact), 1.0 / std::sqrt(12.0), 0.03);
    std::vector<float> values = stored;
    SurfaceSmoother(make_grid(kWidth)).smooth(stored, kMaxSmoothingRounds, 0.4375f, values);
    EXPECT_LT(rms_difference(values, exact), 0.6 / std::sqrt(12.0));
}

LowRank make_matrix(std::vector<int16_t> mean, uint32_t fraction_bits, uint32_t rounds) {
    LowRank matrix;
    matrix.num_points = 4;
    matrix.num_planes = 1;
    matrix.num_poses = 1;
    matrix.mean = std::move(mean);
    matrix.steps = {0.5f};
    matrix.fraction_bits = fraction_bits;
    matrix.smoothing = {rounds};
    return matrix;
}

TEST(SmoothStored, ScalesIntegersAndSteps) {
    LowRank matrix = make_matrix({0, 1, 1, -7}, 4, 1);
    smooth_stored(matrix, kTriangle);
    EXPECT_EQ(matrix.mean, StoredValues(std::vector<int16_t>{7, 12, 12, -112}));
    EXPECT_EQ(matrix.steps, std::vector<float>{0.5f / 16.0f});
    EXPECT_EQ(stored_integers(matrix.mean, 4), StoredValues(std::vector<int8_t>{0, 1, 1, -7}));

    LowRank plain = make_matrix({0, 1, 1, -7}, 0, 1);
    smooth_stored(plain, kTriangle);
    EXPECT_EQ(plain.mean, StoredValues(std::vector<int16_t>{0, 1, 1, -7}));
}

TEST(SmoothStored, NeverLeavesTheIntegersThatWereStored) {
    constexpr uint32_t kWidth = 20;
    for (const uint32_t bits : {2u, 3u, 4u}) {
        LowRank matrix;
        matrix.num_points = kWidth * kWidth;
        matrix.num_planes = 1;
        matrix.num_poses = 1;
        std::vector<int16_t> integers;
        for (uint32_t v = 0; v < matrix.num_points; ++v) {
            integers.push_back(static_cast<int16_t>(static_cast<int>(v * 977 % 4001) - 2000));
        }
        matrix.mean = integers;
        matrix.steps = {1.0f};
        matrix.fraction_bits = bits;
        matrix.smoothing = {8};
        smooth_stored(matrix, make_grid(kWidth));
        EXPECT_EQ(stored_integers(matrix.mean, bits), StoredValues(integers)) << bits;
    }
}

// Planes of all numbers of rounds, more than are smoothed at once, of both types, over vertices of
// few, many and no neighbours.
LowRank many_planes(const Topology& mesh, uint32_t fraction_bits) {
    LowRank matrix;
    matrix.num_points = mesh.num_vertices;
    matrix.num_planes = 3;
    matrix.num_poses = 1;
    matrix.num_components = 15;
    matrix.steps.assign(matrix.num_planes, 1.0f);
    matrix.fraction_bits = fraction_bits;
    RandomStream random(7);
    const auto fill = [&]<typename Integer>(std::vector<Integer> values, double limit) {
        for (Integer& value : values) {
            value = static_cast<Integer>(std::lround(limit * (2.0 * random.uniform() - 1.0)));
        }
        return StoredValues(std::move(values));
    };
    const double limit = std::floor(32767.0 / (1 << fraction_bits)) - 1.0;
    matrix.mean = fill(std::vector<int16_t>(matrix.num_rows()), limit);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        // Values of a few steps are moved the farthest; those of most steps are always held back.
        matrix.components.push_back(k % 3 == 0
                                        ? fill(std::vector<int16_t>(matrix.num_rows()), limit)
                                        : fill(std::vector<int8_t>(matrix.num_rows()), 2.0));
    }
    for (uint32_t j = 0; j < 3 * (1 + matrix.num_components); ++j) {
        matrix.smoothing.push_back(j % (kMaxSmoothingRounds + 1));
    }
    return matrix;
}

TEST(SmoothStored, GivesTheSameBytesOnEveryVectorUnit) {
    Topology mesh = make_grid(50);
    for (uint32_t v = 1; v + 1 < mesh.num_vertices; v += 7) {
        mesh.triangles.push_back({0, v, v + 1});  // many neighbours
    }
    mesh.num_vertices += 3;  // without any
    const SurfaceSmoother smoother(mesh);
    for (const uint32_t bits : {2u, 4u}) {
        LowRank expected = many_planes(mesh, bits);
        smooth_stored(expected, smoother, VectorUnit::plain);
        for (const VectorUnit unit : vector_units()) {
            LowRank matrix = many_planes(mesh, bits);
            smooth_stored(matrix, smoother, unit);
            EXPECT_TRUE(matrix == expected) << static_cast<int>(unit) << ", " << bits;
        }
    }
}

TEST(SmoothingFractionBits, LeaveRoomInSixteenBits) {
    const auto bits = [](int16_t largest) {
        return smoothing_fraction_bits(make_matrix({0, 0, 0, largest}, 0, 0));
    };
    EXPECT_EQ(bits(100), 4u);
    EXPECT_EQ(bits(2047), 4u);
    EXPECT_EQ(bits(-2048), 3u);
    EXPECT_EQ(bits(4096), 2u);
    EXPECT_EQ(bits(8191), 2u);
    EXPECT_EQ(bits(8192), 0u);
}

}  // namespace
}  // namespace paim
