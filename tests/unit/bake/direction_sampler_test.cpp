// The directions in which a vertex looks: what they average to, in one batch or in several.
#include "compressor/bake/direction_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "paim/base/seed.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"

namespace paim {
namespace {

constexpr int kBands = 4;
constexpr size_t kCoefficients = 16;
using Sums = std::array<double, kCoefficients>;

class DirectionSamplers : public testing::TestWithParam<SamplerKind> {};

void add_basis(const RaySet& rays, Sums& sums) {
    Sums y{};
    for (size_t j = 0; j < rays.num_rays; ++j) {
        sh::evaluate_basis(kBands, Vec3d(rays.x[j], rays.y[j], rays.z[j]), std::span(y));
        for (size_t i = 0; i < kCoefficients; ++i) sums[i] += double{rays.weights[j]} * y[i];
    }
}

TEST_P(DirectionSamplers, AverageTheBasisToTheCosineLobe) {
    // Means over 2000 independent keys of 16 points each; their own spread says how far they may be
    // off.
    constexpr int kKeys = 2000;
    const Vec3f normal = Vec3f(0.3f, -0.8f, 0.5f).normalized();
    const auto sampler = make_sampler(GetParam(), 0, 16);
    Sums mean{}, square{};
    RaySet rays;
    for (uint64_t key = 0; key < kKeys; ++key) {
        sampler->generate(normal, stream_key(1, 2, key), rays);
        Sums sums{};
        add_basis(rays, sums);
        for (size_t i = 0; i < kCoefficients; ++i) {
            const double value = sums[i] / sampler->num_points();
            mean[i] += value / kKeys;
            square[i] += value * value / kKeys;
        }
    }
    Sums at_normal{};
    sh::evaluate_basis(kBands, normal.cast<double>(), std::span(at_normal));
    for (size_t i = 0; i < kCoefficients; ++i) {
        const double expected = sh::cosine_lobe(sh::band_of(static_cast<int>(i))) * at_normal[i];
        const double error = std::sqrt(std::max(0.0, square[i] - mean[i] * mean[i]) / kKeys);
        // Sixteen coefficients: beyond 4 standard errors once in a thousand seeds. Where all points
        // count the same (y_00 of the cosine sampler) there is only rounding.
        EXPECT_NEAR(mean[i], expected, 4.0 * error + 1e-7) << i;
    }
}

// Of the light that passes an edge, from 16 points to 256.
TEST_P(DirectionSamplers, ErrorsFallWithTheirPower) {
    constexpr int kKeys = 4000;
    const Vec3f normal = Vec3f(0.3f, -0.8f, 0.5f).normalized();
    const Vec3f across = Vec3f(0.5f, 0.1f, 0.4f).normalized();
    const auto variance = [&](uint32_t count) {
        const auto sampler = make_sampler(GetParam(), 0, count);
        RaySet rays;
        double sum = 0.0, squares = 0.0;
        for (uint64_t key = 0; key < kKeys; ++key) {
            sampler->generate(normal, stream_key(1, 2, key), rays);
            double passed = 0.0;
            for (size_t j = 0; j < rays.num_rays; ++j) {
                const bool open = Vec3f(rays.x[j], rays.y[j], rays.z[j]).dot(across) > 0.1f;
                passed += open ? double{rays.weights[j]} / count : 0.0;
            }
            sum += passed;
            squares += passed * passed;
        }
        return squares / kKeys - sum * sum / (double{kKeys} * kKeys);
    };
    const double power = std::log(variance(16) / variance(256)) / std::log(16.0);
    // A variance of 4000 is known to 2 %, the power to 0.01. For nets it is that of edges that are
    // as likely to be anywhere, which this one is not quite.
    EXPECT_NEAR(power, error_power(GetParam()), 0.2);
}

TEST_P(DirectionSamplers, BatchesAreTheSequence) {
    const Vec3f normal = Vec3f(-0.2f, 0.1f, 0.9f).normalized();
    const uint64_t key = stream_key(3, 1, 4);
    const auto sorted_rays = [&](std::initializer_list<std::pair<uint32_t, uint32_t>> ranges) {
        std::vector<std::array<float, 4>> all;
        RaySet rays;
        for (const auto& [first, count] : ranges) {
            make_sampler(GetParam(), first, count)->generate(normal, key, rays);
            for (size_t j = 0; j < rays.num_rays; ++j) {
                all.push_back({rays.x[j], rays.y[j], rays.z[j], rays.weights[j]});
            }
        }
        std::sort(all.begin(), all.end());
        return all;
    };
    const auto whole = sorted_rays({{0, 200}});
    EXPECT_EQ(sorted_rays({{0, 32}, {32, 32}, {64, 64}, {128, 72}}), whole);
    EXPECT_NE(sorted_rays({{0, 32}, {32, 32}, {64, 64}, {140, 60}}), whole);
}

TEST_P(DirectionSamplers, TraceNothingBelowTheHorizonAndPadWithZeros) {
    const Vec3f normal = Vec3f(0.5f, 0.5f, -0.7f).normalized();
    RaySet rays;
    make_sampler(GetParam(), 0, 100)->generate(normal, 7, rays);
    ASSERT_GT(rays.num_rays, 30u);
    ASSERT_EQ(rays.x.size() % 16, 0u);
    for (size_t j = 0; j < rays.num_rays; ++j) {
        const Vec3f w(rays.x[j], rays.y[j], rays.z[j]);
        EXPECT_NEAR(w.norm(), 1.0f, 1e-6f);  // a few roundings of float
        EXPECT_GE(w.dot(normal), -1e-6f);
        EXPECT_GT(rays.weights[j], 0.0f);
    }
    for (size_t j = rays.num_rays; j < rays.x.size(); ++j) EXPECT_EQ(rays.weights[j], 0.0f);
}

INSTANTIATE_TEST_SUITE_P(All, DirectionSamplers, testing::ValuesIn(kSamplerKinds));

}  // namespace
}  // namespace paim
