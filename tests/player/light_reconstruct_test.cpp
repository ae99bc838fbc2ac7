// Radiance from coefficients against sums over the reference basis, and lights that ring.
#include "player/light/reconstruct_light.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/sh/basis_reference.h"

namespace paim::player {
namespace {

LightCoefficients random_light(int bands, RandomStream& random) {
    LightCoefficients light{bands, std::vector<Vec3f>(static_cast<size_t>(bands * bands))};
    for (Vec3f& value : light.values) {
        for (int c = 0; c < 3; ++c) value[c] = static_cast<float>(2.0 * random.uniform() - 1.0);
    }
    return light;
}

TEST(ReconstructLight, IsTheSumOverTheBasis) {
    RandomStream random(stream_key(5, 2, 1));
    const std::vector<Vec3f> all = equal_area_directions(700);
    for (const int bands : {1, 3, 10, 20}) {
        const LightCoefficients light = random_light(bands, random);
        // Not a multiple of the batch, and more than one piece of the parallel loop.
        for (const size_t count : {size_t{1}, size_t{17}, size_t{700}}) {
            const std::span<const Vec3f> directions(all.data(), count);
            std::vector<Vec3f> radiance(count);
            reconstruct_light(light, directions, radiance);
            for (size_t j = 0; j < count; j += 13) {
                Vec3d expected = Vec3d::Zero();
                for (int l = 0; l < bands; ++l) {
                    for (int m = -l; m <= l; ++m) {
                        expected +=
                            sh::basis_reference(l, m, directions[j].cast<double>().normalized()) *
                            light.values[static_cast<size_t>(sh::index(l, m))].cast<double>();
                    }
                }
                // Up to 400 terms of about 1, each to 3e-6 at worst, random in sign.
                EXPECT_LT((radiance[j].cast<double>() - expected).cwiseAbs().maxCoeff(), 1e-4)
                    << bands << " " << j;
            }
        }
    }
}

// y_10 is negative on one half of the sphere, 1 + a z where z < −1/a.
TEST(NegativeShare, IsTheShareOfTheSphere) {
    LightCoefficients light{2, std::vector<Vec3f>(4, Vec3f::Zero())};
    EXPECT_EQ(negative_share(light), 0.0);
    light.values[2] = Vec3f::Ones();
    EXPECT_NEAR(negative_share(light), 0.5, 0.001);
    // One channel: sqrt(1/4π) + 2 sqrt(3/4π)/sqrt(3) z.
    light.values[0] = Vec3f::Ones();
    light.values[2] = Vec3f(0.0f, 0.0f, static_cast<float>(2.0 / std::sqrt(3.0)));
    EXPECT_NEAR(negative_share(light), 0.25, 0.001);
    light.values[0] = Vec3f::Constant(3.0f);
    EXPECT_EQ(negative_share(light), 0.0);
}

TEST(EqualAreaDirections, CoverTheSphereEvenly) {
    const std::vector<Vec3f> directions = equal_area_directions(4096);
    ASSERT_EQ(directions.size(), 4096u);
    Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
    Vec3d mean = Vec3d::Zero();
    for (const Vec3f& direction : directions) {
        EXPECT_NEAR(direction.norm(), 1.0f, 1e-6f);
        mean += direction.cast<double>() / 4096.0;
        moments += direction.cast<double>() * direction.cast<double>().transpose() / 4096.0;
    }
    // Heights lie symmetrically about 0. The lattice integrates other low polynomials to about 1/n.
    EXPECT_NEAR(mean.z(), 0.0, 1e-6);
    EXPECT_LT(mean.norm(), 1e-3);
    EXPECT_LT((moments - Eigen::Matrix3d::Identity() / 3.0).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_EQ(equal_area_directions(1).size(), 1u);
    // No two are close: of n discs of the same area as the sphere, each has the radius 2/sqrt(n).
    const std::vector<Vec3f> few = equal_area_directions(400);
    for (size_t i = 0; i < few.size(); ++i) {
        for (size_t j = 0; j < i; ++j) ASSERT_GT((few[i] - few[j]).norm(), 2.0f / 20.0f);
    }
}

}  // namespace
}  // namespace paim::player
