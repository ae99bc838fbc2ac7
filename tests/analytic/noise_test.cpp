// What the bake promises of its noise: no bias, how fast it falls, what it costs against plain
// samplers.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/study/baked_matrices.h"
#include "compressor/bake/noise_target.h"
#include "compressor/bake/transfer_baker.h"
#include "compressor/encode/noise/component_noise.h"
#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/noise/shrinkage.h"
#include "compressor/encode/svd/projected_blocks.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/analytic/bias.h"

namespace paim {
namespace {

using Eigen::Index;
using study::bake_matrices;
using study::BakedMatrices;
using study::Truth;

BakeOptions options(SamplerKind sampler, uint32_t rays, uint64_t seed) {
    BakeOptions result;
    result.rays = rays;
    result.seed = seed;
    result.sampler = sampler;
    return result;
}

TEST(BakeNoise, IsUnbiasedOnTheOctopus) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    EXPECT_LT(largest_z(octopus, SamplerKind::cosine, 64, 16), kLargestZ);
    const double few = largest_z(octopus, SamplerKind::cosine, 6, 16);
    RecordProperty("z_of_6", std::to_string(few));
    EXPECT_LT(few, kLargestZ);
    EXPECT_LT(largest_z(octopus, SamplerKind::uniform_sobol, 64, 16), kLargestZ);
}

TEST(BakeNoise, IsUnbiasedInTheBowl) {
    const PoseSet bowl = poses::make_pose_set(*poses::make_bowl_sequence(1000), 1);
    EXPECT_LT(largest_z(bowl, SamplerKind::cosine, 64, 16), kLargestZ);
    const double few = largest_z(bowl, SamplerKind::cosine, 6, 16);
    RecordProperty("z_of_6", std::to_string(few));
    EXPECT_LT(few, kLargestZ);
}

TEST(BakeNoise, FallsAsTheThreeQuarterPowerOfTheRays) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const Truth truth(
        bake_matrices(octopus, options(SamplerKind::cosine, kReferenceRays, 1000), 1));
    const auto error = [&](uint32_t rays) {
        return truth.error(
            bake_matrices(octopus, options(SamplerKind::cosine, rays, 1), 1).transfer);
    };
    const double order = std::log(error(512) / error(4096)) / std::log(8.0);
    RecordProperty("order", std::to_string(order));
    // Each error is an RMS over a thousand vertices of unequal noise, known to about 3 %: the order
    // to √2 · 0.03 / ln 8 = 0.02. Random directions would have 0.5.
    EXPECT_GT(order, 0.75 - 0.02);
}

TEST(BakeNoise, NeedsAFractionOfTheRaysOfPlainSamplers) {
    const PoseSet octopus = poses::make_octopus(2000, 1);
    const Truth truth(
        bake_matrices(octopus, options(SamplerKind::cosine, kReferenceRays, 1000), 1));
    const auto error = [&](SamplerKind sampler, double rays_above_the_horizon) {
        // Half of the points of the sphere are above it; those below cost nothing.
        const double points =
            sampler == SamplerKind::cosine ? rays_above_the_horizon : 2.0 * rays_above_the_horizon;
        const auto even = 2 * static_cast<uint32_t>(points / 2.0);
        return truth.error(bake_matrices(octopus, options(sampler, even, 1), 1).transfer);
    };
    for (const double rays : {64.0, 256.0}) {
        const double cosine = error(SamplerKind::cosine, rays);
        const double random = cosine / error(SamplerKind::uniform, 20.0 * rays);
        const double sobol = cosine / error(SamplerKind::uniform_sobol, 1.25 * rays);
        RecordProperty(fmt::format("of_random_{}", rays), std::to_string(random));
        RecordProperty(fmt::format("of_sobol_{}", rays), std::to_string(sobol));
        // Both factors are observed, not derived: with 64 and 256 rays, errors were 0.62 and 0.43
        // of those of random directions, 0.48 and 0.64 of those of low-discrepancy ones. Each is an
        // RMS over 2000 vertices of unequal noise, known to about 2 %.
        EXPECT_LT(random, 1.0) << rays;
        EXPECT_LT(sobol, 1.0) << rays;
    }
}

// The transfer as `auto` would encode it, decoded.
Eigen::MatrixXf encoded(const BakedMatrices& baked, uint32_t bands) {
    const MatrixRows transfer(baked.transfer);
    const PrincipalComponents components = principal_components(transfer);
    const ComponentNoise noise = measure_component_noise(
        transfer, MatrixRows(baked.noise), {TransferKind::diffuse, bands, 1}, components);
    const uint32_t kept = choose_components({}, noise, 0.01);
    const Shrinkage shrinkage(noise);
    Eigen::MatrixXf decoded(baked.transfer.rows(), baked.transfer.cols());
    const std::vector<float> weights = component_weights(components, kept, transfer.num_rows());
    const Eigen::Map<const Eigen::Matrix<float, -1, -1, Eigen::RowMajor>> w(
        weights.data(), static_cast<Index>(kept), decoded.cols());
    Index row = 0;
    for_each_encoded_block(transfer, components, kept, [&](EncodedRows& block) {
        shrinkage.apply(static_cast<uint64_t>(row), block.components);
        const auto count = static_cast<Index>(block.mean.size());
        Eigen::MatrixXf u(count, static_cast<Index>(kept));
        for (uint32_t k = 0; k < kept; ++k) {
            u.col(k) = Eigen::Map<const Eigen::VectorXf>(block.components[k].data(), count);
        }
        const Eigen::Map<const Eigen::VectorXf> mean(block.mean.data(), count);
        decoded.middleRows(row, count) = (u * w).colwise() + mean;
        row += count;
    });
    return decoded;
}

// What the encoder would print for it.
double expected_error(const BakedMatrices& baked, uint32_t bands) {
    const MatrixRows transfer(baked.transfer);
    const ComponentNoise noise =
        measure_component_noise(transfer, MatrixRows(baked.noise),
                                {TransferKind::diffuse, bands, 1}, principal_components(transfer));
    const double energy = baked.transfer.cast<double>().squaredNorm();
    const uint32_t kept = choose_components({}, noise, 0.01);
    return std::sqrt(Shrinkage(noise).expected_error(kept).total() / energy);
}

// The matrix with its mean and the first components alone, neither shrunk nor rounded.
Eigen::MatrixXf truncated(const Eigen::MatrixXf& matrix, const Eigen::MatrixXd& v, Index kept) {
    const Eigen::VectorXd mean = matrix.cast<double>().rowwise().mean();
    const Eigen::MatrixXd centred = matrix.cast<double>().colwise() - mean;
    const Eigen::MatrixXd within = centred * v.leftCols(kept) * v.leftCols(kept).transpose();
    return (within.colwise() + mean).cast<float>();
}

TEST(BakeNoise, IsTakenOutAgainByEncoding) {
    constexpr uint32_t kPoses = 24;
    const PoseSet octopus = poses::make_octopus(1000, kPoses);
    const BakedMatrices exact =
        bake_matrices(octopus, options(SamplerKind::cosine, 4096, 1000), kPoses);
    const Truth truth(exact);
    const BakedMatrices baked = bake_matrices(octopus, options(SamplerKind::cosine, 64, 1), kPoses);
    const Eigen::MatrixXf decoded = encoded(baked, 5);
    RecordProperty("of_bake", std::to_string(truth.error(decoded) / truth.error(baked.transfer)));
    RecordProperty("flicker_of_bake",
                   std::to_string(truth.flicker(decoded) / truth.flicker(baked.transfer)));

    // Without shrinkage, and with the best number of components that one who knows the truth can
    // choose. All of them are the bake itself.
    const Eigen::MatrixXd v = principal_components(MatrixRows(baked.transfer)).v;
    double least_error = 1e9, least_flicker = 1e9;
    Index best = 0;
    for (Index k = 0; k < Index{kPoses}; ++k) {
        const Eigen::MatrixXf cut = truncated(baked.transfer, v, k);
        if (truth.error(cut) < least_error) best = k;
        least_error = std::min(least_error, truth.error(cut));
        least_flicker = std::min(least_flicker, truth.flicker(cut));
    }
    EXPECT_LT(truth.error(decoded), least_error);
    EXPECT_LT(truth.flicker(decoded), least_flicker);

    // As the noise of a pose is independent of all others', mean and K components let 1 + K of P
    // parts through. And they lack the part of the truth that lies beyond them.
    const double share = (1.0 + static_cast<double>(best)) / kPoses;
    const Eigen::MatrixXd left =
        (exact.transfer - truncated(exact.transfer, v, best)).cast<double>();
    const double lacking =
        left.squaredNorm() - (1.0 - share) * exact.noise.cast<double>().squaredNorm();
    const double energy = exact.transfer.cast<double>().squaredNorm();
    const double expected =
        std::hypot(std::sqrt(share) * truth.error(baked.transfer), std::sqrt(lacking / energy));
    RecordProperty("best", std::to_string(best));
    RecordProperty("least_of_expected", std::to_string(least_error / expected));
    // In a third of the poses' directions, the noise of 1000 vertices is known to about 5 %.
    EXPECT_NEAR(least_error / expected, 1.0, 0.05);

    // 2.5 times the rays above the horizon, 5 times the points. That it is so many is observed: the
    // error was half of theirs.
    const BakedMatrices plain =
        bake_matrices(octopus, options(SamplerKind::uniform_sobol, 5 * 64, 1), kPoses);
    RecordProperty("of_sobol", std::to_string(truth.error(decoded) / truth.error(plain.transfer)));
    EXPECT_LT(truth.error(decoded), truth.error(plain.transfer));
}

// Six poses of plates are three different ones, there and back: two components. More would be
// noise.
TEST(BakeNoise, IsNeverTakenForSignal) {
    const PoseSet plates = poses::make_pose_set(*poses::make_plates_sequence(1000), 6);
    for (uint64_t seed = 1; seed <= 6; ++seed) {
        for (const double target : {0.0, 0.03}) {
            BakeOptions bake = options(SamplerKind::cosine, target > 0.0 ? 16384 : 96, seed);
            bake.transfer_error = target;
            const BakedMatrices baked = bake_matrices(plates, bake, 6);
            const MatrixRows transfer(baked.transfer);
            const ComponentNoise noise = measure_component_noise(transfer, MatrixRows(baked.noise),
                                                                 {TransferKind::diffuse, 5, 1},
                                                                 principal_components(transfer));
            EXPECT_EQ(noise.num_above_noise, 2u) << seed << ' ' << target;
        }
    }
}

// With few poses, where a vertex's noise is known from few draws, as with many.
TEST(BakeNoise, LeavesTheErrorThatTheEncoderExpects) {
    for (const uint32_t num_poses : {2u, 6u, 24u}) {
        const PoseSet octopus = poses::make_octopus(2000, num_poses);
        const Truth truth(
            bake_matrices(octopus, options(SamplerKind::cosine, 2048, 1000), num_poses));
        const BakedMatrices baked =
            bake_matrices(octopus, options(SamplerKind::cosine, 64, 1), num_poses);
        const double expected = expected_error(baked, 5);
        // Observed: off by -1.3, -1.6 and +1.0 % here, by up to 3.5 % on real meshes. The model
        // behind it is one, so that no bound can be derived; an RMS over 2000 vertices adds 2 %.
        const double ratio = expected / truth.error(encoded(baked, 5));
        RecordProperty(fmt::format("expected_{}", num_poses), std::to_string(ratio));
        EXPECT_NEAR(ratio, 1.0, 0.05) << num_poses;
    }
}

TEST(BakeNoise, MeetsTheErrorAskedFor) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const BakedMatrices reference =
        bake_matrices(octopus, options(SamplerKind::cosine, kReferenceRays, 1000), 1);
    const double open = open_transfer_norm(5) * std::sqrt(1000.0);
    BakeOptions bake = options(SamplerKind::cosine, 16384, 1);
    uint64_t rays_before = 0;
    for (const double target : {0.1, 0.03}) {
        bake.transfer_error = target;
        const BakedMatrices baked = bake_matrices(octopus, bake, 1);
        const double error = (baked.transfer - reference.transfer).norm() / open;
        // Sizes of rounds grow by a third to a half, and errors fall by up to 1.5^0.75 with what is
        // too much: to 0.74 of the target, and to less at vertices that have hardly any noise, or for
        // which the first 64 rays are more than enough. Observed: 0.58 and 0.87 of the target.
        RecordProperty(fmt::format("of_target_{}", target), std::to_string(error / target));
        EXPECT_LT(error, target);
        EXPECT_GT(error, 0.5 * target);
        EXPECT_GT(baked.num_rays, 2 * rays_before);
        rays_before = baked.num_rays;
    }
    // What cannot be met is counted.
    bake.rays = 128;
    const TransferBaker baker(bake);
    const BakedPose pose = baker.bake(octopus.topology(), octopus.load_pose(0), 0);
    RecordProperty("above", std::to_string(pose.statistics.above_target));
    // The same by a bake of 128 rays at every vertex, which are other ones.
    const BakedMatrices at_once = bake_matrices(octopus, options(SamplerKind::cosine, 128, 2), 1);
    std::vector<double> noise_energy(1000, 0.0);
    for (Index row = 0; row < at_once.noise.rows(); ++row) {
        noise_energy[static_cast<size_t>(row) % 1000] += std::pow(at_once.noise(row, 0), 2.0);
    }
    std::vector<uint32_t> all(1000);
    std::iota(all.begin(), all.end(), 0u);
    const double target_norm = bake.transfer_error * open_transfer_norm(5);
    // Two rounds of 64 rays know less than one of 128.
    const double power = error_power(SamplerKind::cosine);
    for (double& energy : noise_energy) energy *= std::pow(2.0, power - 1.0);
    const size_t expected =
        above_noise_target(Neighbours(octopus.topology()), noise_energy,
                           std::vector<double>(1000, 1.0), power, target_norm * target_norm, all)
            .size();
    RecordProperty("above_expected", std::to_string(expected));
    // A vertex is judged by its neighbours' noise, which six others are judged by too: counts
    // scatter by at most √(1000 · 0.25 · 7) = 42, differences of two by √2 times that, and three
    // times those are 180. Vertices that an earlier batch acquitted by luck are fewer than that.
    EXPECT_NEAR(pose.statistics.above_target, static_cast<double>(expected), 180.0);
    EXPECT_LE(pose.statistics.rays, 128u * 1000u);
}

}  // namespace
}  // namespace paim
