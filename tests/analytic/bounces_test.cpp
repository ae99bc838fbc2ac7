// Light that bounces, where its sum is known: furnaces, bowls, facing plates.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "compressor/bake/transfer_baker.h"
#include "paim/base/tbb_parallel.h"
#include "paim/mesh/pose_set.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim {
namespace {

const double kY00 = std::sqrt(0.25 / kPi);

BakeOptions make_options(uint32_t bands, uint32_t rays, uint32_t bounces, uint64_t seed = 1) {
    BakeOptions options{bands, rays, seed};
    options.bounces = bounces;
    return options;
}

// Radiance in a constant light of 1 that one half says, were the vertex itself white. [V]
std::vector<double> furnace(const BakedPose& baked, size_t num_vertices, size_t channel,
                            size_t num_coefficients, int half) {
    std::vector<double> radiance(num_vertices);
    for (size_t v = 0; v < num_vertices; ++v) {
        const size_t r = channel * num_coefficients * num_vertices + v;
        const double noise = half == 0 ? baked.noise[r] : -baked.noise[r];
        radiance[v] = (baked.transfer[r] + noise) / kY00;
    }
    return radiance;
}

const Albedo kWhite{{Vec3f::Ones()}};

TEST(Bounces, OctopusInAWhiteFurnaceTurnsWhite) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const size_t num_vertices = octopus.topology().num_vertices;
    // What is missing from 1, e_N = K e_(N-1), where K is a matrix of weights whose rows sum up to
    // the occluded attribute, e_0 (closed surface: no back is seen). So e_N(v) <= e_0(v) max
    // e_(N-1), and as K has no negative entries the largest ratio of e_N to e_(N-1) never grows.
    std::vector<std::vector<double>> missing[2];
    for (const uint32_t bounces : {0u, 1u, 2u, 3u, 4u, 8u}) {
        const TransferBaker baker(make_options(1, 256, bounces), kWhite);
        const BakedPose baked = baker.bake(octopus.topology(), octopus.load_pose(0), 0);
        EXPECT_EQ(baker.layout().channels, 1u);
        EXPECT_EQ(baked.statistics.back_hits, 0u);
        for (int half = 0; half < 2; ++half) {
            auto& e = missing[half].emplace_back(furnace(baked, num_vertices, 0, 1, half));
            for (double& value : e) value = 1.0 - value;
        }
    }
    // Sums of floats of about 1, each rounded to 6e-8 some ten times.
    constexpr double kRounding = 1e-6;
    for (const auto& e : missing) {
        double last_ratio = 1.0;
        for (size_t n = 1; n <= 4; ++n) {
            const double largest = *std::max_element(e[n - 1].begin(), e[n - 1].end());
            double ratio = 0.0;
            for (size_t v = 0; v < num_vertices; ++v) {
                EXPECT_GE(e[n][v], -kRounding);
                EXPECT_LE(e[n][v], e[n - 1][v] + kRounding);
                EXPECT_LE(e[n][v], e[0][v] * largest + kRounding);
                if (e[n - 1][v] > 1e-3) ratio = std::max(ratio, e[n][v] / e[n - 1][v]);
            }
            EXPECT_LE(ratio, last_ratio + 1e-3) << n;
            last_ratio = ratio;
        }
        // Four more bounces each take at least what the last one did.
        for (size_t v = 0; v < num_vertices; ++v) {
            EXPECT_LE(e[5][v], std::pow(last_ratio, 4) * e[4][v] + kRounding);
        }
    }
}

TEST(Bounces, BowlGetsHalfOfWhatIsMissingEachTime) {
    // Every point of half a sphere sees the other half of its sky as itself.
    const PoseSet bowl = poses::make_pose_set(*poses::make_bowl_sequence(2000), 1);
    const size_t num_vertices = bowl.topology().num_vertices;
    for (const uint32_t bounces : {0u, 1u, 2u, 4u, 16u}) {
        const TransferBaker baker(make_options(1, 1024, bounces, 3), kWhite);
        const BakedPose baked = baker.bake(bowl.topology(), bowl.load_pose(0), 0);
        double mean = 0.0, worst = 0.0;
        const double expected = 1.0 - std::pow(0.5, bounces + 1);
        for (size_t v = 0; v < num_vertices; ++v) {
            const double radiance = static_cast<double>(baked.transfer[v]) / kY00;
            mean += radiance / static_cast<double>(num_vertices);
            worst = std::max(worst, std::abs(radiance - expected));
        }
        RecordProperty("mean_" + std::to_string(bounces), std::to_string(mean));
        // The flat mesh blocks 0.5 +- 0.008 (transfer_test.cpp), and (N + 1) times that changes
        // 0.5^(N + 1) by (N + 1) 0.5^N 0.008.
        const double tolerance = (bounces + 1) * std::pow(0.5, bounces) * 0.008;
        EXPECT_NEAR(mean, expected, tolerance) << bounces;
        // Single vertices have the noise of 1024 rays, and on the rim that of seeing flat triangles
        // edge-on, which blocks up to 0.05 less; each bounce divides all of it by two.
        EXPECT_LT(worst, (bounces + 1) * std::pow(0.5, bounces) * 0.06) << bounces;
    }
}

// Both plates as one mesh, in their first pose, at distance 1, the upper one coloured.
struct Plates {
    PoseSet both = poses::make_pose_set(*poses::make_plates_sequence(800), 1);
    size_t num_lower = both.topology().num_vertices / 2;
    Pose pose = both.load_pose(0);
    Vec3f lower{0.8f, 0.8f, 0.8f};
    Vec3f upper{0.9f, 0.3f, 0.0f};
    Albedo albedo;

    Plates() {
        albedo.values.assign(num_lower, lower);
        albedo.values.resize(2 * num_lower, upper);
    }

    // Attribute of one, as a mesh of its own; faces turned round if asked.
    PoseSet plate(bool of_upper, bool turned) const {
        const auto first = static_cast<uint32_t>(of_upper ? num_lower : 0);
        Topology topology{static_cast<uint32_t>(num_lower), {}};
        for (const Triangle& t : both.topology().triangles) {
            if ((t[0] >= num_lower) != of_upper) continue;
            Triangle moved{t[0] - first, t[1] - first, t[2] - first};
            if (turned) std::swap(moved[1], moved[2]);
            topology.triangles.push_back(moved);
        }
        return PoseSet(topology,
                       {{pose.positions.begin() + first,
                         pose.positions.begin() + first + static_cast<ptrdiff_t>(num_lower)}},
                       {{of_upper ? upper : lower}});
    }
};

TEST(Bounces, PlatesBleedTheirColour) {
    const Plates plates;
    const TransferBaker baker(make_options(1, 4096, 1), plates.albedo);
    EXPECT_EQ(baker.layout().channels, 3u);
    const BakedPose baked = baker.bake(plates.both.topology(), plates.pose, 0);
    EXPECT_EQ(baked.statistics.back_hits, 0u);
    const size_t num_vertices = plates.pose.positions.size();
    // In a constant light of 1, a point of the upper plate shows albedo (1 - F) by what the lower
    // one hides, and a point x of the lower one gets of it, besides its own 1 - F,
    // 1/pi Integral albedo (1 - F(y)) / |x - y|^4 dy over the upper plate, at distance 1.
    constexpr int kCells = 400;
    double worst = 0.0;
    for (size_t v = 0; v < plates.num_lower; v += 7) {
        const Vec3d x = plates.pose.positions[v].cast<double>();
        double bounced = 0.0;
        for (int j = 0; j < kCells; ++j) {
            for (int i = 0; i < kCells; ++i) {
                const double a = (2.0 * i + 1.0) / kCells - 1.0, b = (2.0 * j + 1.0) / kCells - 1.0;
                const double d2 = (a - x.x()) * (a - x.x()) + (b - x.z()) * (b - x.z()) + 1.0;
                bounced += (1.0 - poses::plates_blocked(a, b, 1.0)) / (kPi * d2 * d2);
            }
        }
        bounced *= 4.0 / (kCells * kCells);
        const double open = 1.0 - poses::plates_blocked(x.x(), x.z(), 1.0);
        for (int channel = 0; channel < 3; ++channel) {
            const double expected = open + static_cast<double>(plates.upper[channel]) * bounced;
            const double found =
                static_cast<double>(
                    baked.transfer[static_cast<size_t>(channel) * num_vertices + v]) /
                kY00;
            worst = std::max(worst, std::abs(found - expected));
        }
    }
    RecordProperty("worst", std::to_string(worst));
    // As for the open part alone (transfer_test.cpp), 0.007 for the worst vertex; interpolating
    // 1 - F over cells of 2/19 adds at most h²/8 · max |F''| < 1e-3.
    EXPECT_LT(worst, 0.008);
}

TEST(Bounces, StillMeshGivesItsOwnLight) {
    const Plates plates;
    const PoseSet lower = plates.plate(false, false);
    for (const bool turned : {false, true}) {
        StillMesh still_mesh;
        still_mesh.add(plates.plate(true, turned));
        for (const uint32_t bounces : {1u, 3u}) {
            TransferBaker baker(make_options(1, 4096, bounces), lower.albedo(), still_mesh);
            EXPECT_EQ(baker.layout().channels, 3u);
            const BakedPose alone = baker.bake_still_mesh();
            EXPECT_EQ(alone.transfer.size(), 3 * plates.num_lower);
            const BakedPose baked = baker.bake(lower.topology(), lower.load_pose(0), 0);
            // The still mesh is lit as if the poses were not there: by all of its sky, and nothing
            // bounces between itself. Its back gives nothing.
            for (size_t v = 0; v < plates.num_lower; ++v) {
                const Vec3f& x = plates.pose.positions[v];
                const double occluded = poses::plates_blocked(x.x(), x.z(), 1.0);
                for (int channel = 0; channel < 3; ++channel) {
                    const double given =
                        turned ? 0.0 : static_cast<double>(plates.upper[channel]) * occluded;
                    const size_t r = static_cast<size_t>(channel) * plates.num_lower + v;
                    EXPECT_NEAR(static_cast<double>(baked.transfer[r]) / kY00,
                                1.0 - occluded + given, 0.007);
                }
            }
            EXPECT_EQ(baked.statistics.back_hits, turned ? baked.statistics.occluded : 0);
        }
    }
}

TEST(Bounces, NoiseEstimateIsTheErrorAgainstManyRays) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const Albedo bright{{Vec3f::Constant(0.9f)}};
    const auto bake = [&](uint32_t rays, uint64_t seed) {
        return TransferBaker(make_options(3, rays, 3, seed), bright)
            .bake(octopus.topology(), octopus.load_pose(0), 0);
    };
    const BakedPose few = bake(64, 1), many = bake(8192, 2);
    double error = 0.0, noise = 0.0;
    for (size_t r = 0; r < few.transfer.size(); ++r) {
        const double difference = few.transfer[r] - many.transfer[r];
        error += difference * difference;
        noise += static_cast<double>(few.noise[r]) * static_cast<double>(few.noise[r]);
    }
    RecordProperty("ratio", std::to_string(std::sqrt(noise / error)));
    // 9000 differences between the halves, a little correlated by bounced light; the reference
    // adds 1 % in quadrature.
    EXPECT_NEAR(std::sqrt(noise / error), 1.0, 0.1);
}

TEST(Bounces, GreyIsOneChannelOfColour) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const auto bake = [&](const Vec3f& color, uint32_t bounces) {
        return TransferBaker(make_options(2, 64, bounces), {{color}})
            .bake(octopus.topology(), octopus.load_pose(0), 0);
    };
    const BakedPose grey = bake(Vec3f::Constant(0.5f), 2);
    const BakedPose coloured = bake(Vec3f(0.5f, 0.5f, 0.2f), 2);
    const size_t num_values = grey.transfer.size();
    EXPECT_EQ(num_values, 4u * octopus.topology().num_vertices);
    ASSERT_EQ(coloured.transfer.size(), 3 * num_values);
    for (const size_t channel : {0u, 1u}) {
        EXPECT_TRUE(
            std::equal(grey.transfer.begin(), grey.transfer.end(),
                       coloured.transfer.begin() + static_cast<ptrdiff_t>(channel * num_values)));
    }
    EXPECT_LT(coloured.transfer[2 * num_values], coloured.transfer[0]);
    // Without bounces colour does not matter.
    EXPECT_EQ(TransferBaker(make_options(2, 64, 0), {{Vec3f(1, 0, 0)}}).layout().channels, 1u);
    EXPECT_EQ(bake(Vec3f(1, 0, 0), 0).transfer, bake(Vec3f::Ones(), 0).transfer);
}

TEST(Bounces, WorkWithAnErrorTargetAndEverySampler) {
    const PoseSet bowl = poses::make_pose_set(*poses::make_bowl_sequence(200), 1);
    for (const SamplerKind sampler :
         {SamplerKind::cosine, SamplerKind::uniform, SamplerKind::uniform_sobol}) {
        for (const double target : {0.0, 0.02}) {
            BakeOptions options = make_options(1, 4096, 16);
            options.sampler = sampler;
            options.transfer_error = target;
            const BakedPose baked =
                TransferBaker(options, kWhite).bake(bowl.topology(), bowl.load_pose(0), 0);
            double mean = 0.0;
            for (const float t : baked.transfer) {
                mean += static_cast<double>(t) / kY00 / static_cast<double>(baked.transfer.size());
            }
            // A white furnace. Samplers of the whole sphere weigh rays so that open and occluded
            // parts add up to 1 only on average: to 1/sqrt(rays) each, and bounced some twice.
            EXPECT_NEAR(mean, 1.0, sampler == SamplerKind::cosine ? 1e-3 : 0.02);
        }
    }
}

TEST(Bounces, DoNotDependOnThreads) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return TransferBaker(make_options(3, 64, 3), octopus.albedo())
            .bake(octopus.topology(), octopus.load_pose(0), 0)
            .transfer;
    };
    EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace paim
