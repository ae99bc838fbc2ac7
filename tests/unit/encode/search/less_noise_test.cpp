// How many rays an error needs, by power laws.
#include "compressor/encode/search/less_noise.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

BakeIdentity identity(const std::string& sampler, uint32_t rays, double noise_target = 0.0) {
    BakeIdentity identity;
    identity.sampler = sampler;
    identity.rays = rays;
    identity.transfer_error = noise_target;
    return identity;
}

TransferError noisy(double error, double missing_bands = 0.0) {
    TransferError best;
    best.error = error;
    best.missing_bands = missing_bands;
    return best;
}

// Encoded, the error falls as rays^-(0.75 · 0.83) with the default sampler. 85 % of 4 % is a 1.176th
// of 4 %, which takes 1.176^(1 / 0.6225) = 1.298 times the rays.
TEST(LessNoise, FollowsThePowerLawOfTheSampler) {
    EXPECT_EQ(less_noise_hint(identity("cosine", 1000), noisy(0.04), 0.04),
              "bake with more --rays: 1300 instead of 1000 should do");
    // Half of it: 2.353^1.606 = 3.95.
    EXPECT_EQ(less_noise_hint(identity("cosine", 1000), noisy(0.04), 0.02),
              "bake with more --rays: 4000 instead of 1000 should do");
    // Random directions have rays^-(0.5 · 0.83): 2.353^2.410 = 7.86.
    EXPECT_EQ(less_noise_hint(identity("uniform", 1000), noisy(0.04), 0.02),
              "bake with more --rays: 7900 instead of 1000 should do");
    EXPECT_EQ(less_noise_hint(identity("cosine", 2), noisy(0.04), 0.04),
              "bake with more --rays: 4 instead of 2 should do");
}

// What missing bands take is not there for noise: √(5² − 4²) = 3.
TEST(LessNoise, CountsMissingBands) {
    EXPECT_EQ(less_noise_hint(identity("cosine", 1000), noisy(0.06, 0.04), 0.05),
              less_noise_hint(identity("cosine", 1000), noisy(0.06), 0.03));
}

// Noise alone falls as error^(1 / 0.83): (0.85 · 0.5)^1.205 = 0.357 of 2 %.
TEST(LessNoise, NamesTheNoiseTargetWhereThereIsOne) {
    EXPECT_EQ(
        less_noise_hint(identity("cosine", 16384, 0.02), noisy(0.04), 0.02),
        "bake with less noise: --noise-target 0.71% instead of 2% should do, with --rays 65000 "
        "or more");
}

// With a fixed count: more or fewer than the bake has.
TEST(LessNoise, CountsRays) {
    EXPECT_EQ(rays_for(identity("cosine", 1000), noisy(0.04), 0.02), 3954u);
    // (0.85 · 4)^-1.606 = 0.14003.
    EXPECT_EQ(rays_for(identity("cosine", 1000), noisy(0.01), 0.04), 142u);
    EXPECT_EQ(rays_for(identity("cosine", 4), noisy(0.001), 0.5), 2u);
    EXPECT_EQ(rays_for(identity("cosine", 1000), noisy(0.0), 0.5), 2u);
    EXPECT_EQ(rays_for(identity("cosine", 512), noisy(0.5), 1e-4), std::nullopt);
    EXPECT_EQ(rays_for(identity("cosine", 512), noisy(0.5, 0.02), 0.02), std::nullopt);
    EXPECT_EQ(rays_for(identity("cosine", 16384, 0.02), noisy(0.04), 0.02), std::nullopt);
}

TEST(LessNoise, SaysWhereNoNumberOfRaysDoes) {
    EXPECT_EQ(less_noise_hint(identity("cosine", 512), noisy(0.5), 1e-4),
              "not even --rays 16777216 would do: ask for a larger error");
    BakeIdentity glossy = identity("cosine", 512);
    glossy.layout.kind = TransferKind::glossy;
    EXPECT_EQ(less_noise_hint(glossy, noisy(0.5), 1e-4),
              "not even --rays 16777216 would do: ask for a larger --max-gloss-error");
}

}  // namespace
}  // namespace paim
