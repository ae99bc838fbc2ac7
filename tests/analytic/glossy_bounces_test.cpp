// Light that bounces among glossy vertices, where its sum is known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "compressor/bake/transfer_baker.h"
#include "paim/base/tbb_parallel.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/gloss_light.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

constexpr double kUnitY00 = 0.28209479177387814;

BakeOptions bounce_options(uint32_t rays, uint32_t bounces, uint32_t out_bands = 1,
                           uint64_t seed = 1) {
    BakeOptions options{3, rays, seed};
    options.gloss_in_bands = 3;
    options.gloss_out_bands = out_bands;
    options.bounces = bounces;
    return options;
}

Materials of_one(const std::string& brdf, const Vec3f& tint = Vec3f::Ones()) {
    return {{{brdf, tint}}, {1}};
}

const Albedo kBlack{{Vec3f::Zero()}};

// A body that reflects half of the light by its albedo is one that does so by a Lambertian BRDF.
TEST(GlossyBounces, OfALambertianSurfaceAreThoseOfItsAlbedo) {
    add_lambertian();
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const Vec3f colour(0.9f, 0.45f, 0.9f);
    const auto bake = [&](const Albedo& albedo, const Materials& materials) {
        const TransferBaker baker(bounce_options(64, 3), albedo, {}, materials);
        EXPECT_EQ(baker.layout().channels, 3u);
        return baker.bake(octopus.topology(), octopus.load_pose(0), 0);
    };
    const BakedPose matte = bake({{colour}}, {});
    const BakedPose glossy = bake(kBlack, of_one("lambertian:0.9", Vec3f(1.0f, 0.5f, 1.0f)));
    ASSERT_EQ(glossy.gloss.size(), matte.transfer.size());
    EXPECT_EQ(glossy.statistics.back_hits, matte.statistics.back_hits);
    for (size_t r = 0; r < matte.transfer.size(); ++r) {
        // Sums of floats of about 1 over three bounces, and tables that are 2e-6 from a constant.
        ASSERT_NEAR(glossy.transfer[r], matte.transfer[r], 2e-5) << r;
        ASSERT_NEAR(glossy.noise[r], matte.noise[r], 2e-5) << r;
        // What it sends out itself: y₀ T = 0.9 t.
        ASSERT_NEAR(kUnitY00 * static_cast<double>(glossy.gloss[r]),
                    0.9 * static_cast<double>(matte.transfer[r]), 2e-5)
            << r;
    }
}

// Every point of a bowl sees half of the sky, and every part of a sphere sends as much light to every
// other. So each bounce is ρ / 2 of the one before.
TEST(GlossyBounces, OfABowlAreAGeometricSeries) {
    add_lambertian();
    const PoseSet bowl = poses::make_pose_set(*poses::make_bowl_sequence(400), 1);
    const auto mean = [&](uint32_t bounces) {
        const TransferBaker baker(bounce_options(512, bounces), kBlack, {},
                                  of_one("lambertian:0.8"));
        const BakedPose baked = baker.bake(bowl.topology(), bowl.load_pose(0), 0);
        const size_t num_vertices = bowl.topology().num_vertices;
        double sum = 0.0;
        for (size_t v = 0; v < num_vertices; ++v) {
            sum += static_cast<double>(baked.transfer[v]) / kUnitY00;
        }
        return sum / static_cast<double>(num_vertices);
    };
    double expected = 0.0, term = 0.5;
    for (uint32_t b = 0; b <= 3; ++b) {
        expected += term;
        term *= 0.4;
        // The flat mesh blocks 0.5 ± 0.008 (bounces_test.cpp).
        EXPECT_NEAR(mean(b), expected, 0.008 * (b + 1)) << b;
    }
}

// Two plates that face each other. The light that one gets of the other is the integral of what the
// other sends out towards it, which a bake without bounces has.
TEST(GlossyBounces, CarryTheLightThatIsSentTowardsTheVertex) {
    const PoseSet plates = poses::make_pose_set(*poses::make_plates_sequence(800), 1);
    const Pose pose = plates.load_pose(0);
    const size_t num_lower = plates.topology().num_vertices / 2;
    Materials upper;
    upper.glossy = {{"phong:0.9,6", Vec3f::Ones()}};
    upper.of_vertex.assign(2 * num_lower, 0);
    std::fill(upper.of_vertex.begin() + static_cast<ptrdiff_t>(num_lower), upper.of_vertex.end(),
              uint16_t{1});
    const auto bake = [&](uint32_t bounces) {
        return TransferBaker(bounce_options(4096, bounces, 4), kBlack, {}, upper)
            .bake(plates.topology(), pose, 0);
    };
    const BakedPose direct = bake(0), once = bake(1);
    const TransferLayout layout{TransferKind::glossy_in_pose, 3, 1, 4};
    const std::vector<uint32_t> rows = glossy_rows(plates.topology(), upper);
    ASSERT_EQ(rows.size(), num_lower);
    // Light of two bands from one side.
    std::vector<double> light(9, 0.0);
    light[0] = 1.0;
    light[3] = 0.8;
    const size_t num_vertices = 2 * num_lower;
    const auto radiance = [&](const BakedPose& baked, size_t v) {
        double sum = 0.0;
        for (size_t i = 0; i < 9; ++i) {
            sum += light[i] * static_cast<double>(baked.transfer[i * num_vertices + v]);
        }
        return sum;
    };
    // 1/π Σ over the upper plate of what its vertices send to x, times cos cos / distance² and their
    // areas: cells of a grid of 20 × 20 vertices on [−1, 1]², a quarter and a half at its edge.
    const auto side = static_cast<size_t>(std::lround(std::sqrt(num_lower)));
    ASSERT_EQ(side * side, num_lower);
    const double cell = 2.0 / static_cast<double>(side - 1);
    size_t num_tested = 0;
    for (size_t v = 0; v < num_lower; v += 37) {
        const Vec3d x = pose.positions[v].cast<double>();
        double expected = 0.0;
        for (size_t r = 0; r < rows.size(); ++r) {
            const Vec3d to = x - pose.positions[rows[r]].cast<double>();
            const double distance2 = to.squaredNorm();
            const double cosine = std::abs(to.y()) / std::sqrt(distance2);
            double area = cell * cell;
            for (const int axis : {0, 2}) {
                if (std::abs(pose.positions[rows[r]][axis]) > 0.999f) area *= 0.5;
            }
            expected += area * cosine * cosine / (kPi * distance2) *
                        gloss_radiance(layout, direct.gloss, r, light, to.normalized());
        }
        const double bounced = radiance(once, v) - radiance(direct, v);
        // The sum over cells of 2/19 is 1e-3 from the integral, at distance 1; noise is that of 4096
        // rays, below 2e-3.
        EXPECT_NEAR(bounced, expected, 4e-3) << v;
        EXPECT_GT(std::abs(expected), 0.008) << v;  // twice the tolerance
        ++num_tested;
    }
    EXPECT_GT(num_tested, 8u);
}

// A still mesh that is glossy gives its light to poses that are not, and the other way round; both as
// if they were one mesh, but that the still mesh does not see the poses.
TEST(GlossyBounces, StillMeshGivesItsGlossyLight) {
    const PoseSet plates = poses::make_pose_set(*poses::make_plates_sequence(200), 1);
    const Pose pose = plates.load_pose(0);
    const auto num_lower = plates.topology().num_vertices / 2;
    const auto plate = [&](bool is_upper) {
        const uint32_t first = is_upper ? num_lower : 0;
        Topology topology{num_lower, {}};
        for (const Triangle& t : plates.topology().triangles) {
            if ((t[0] >= num_lower) != is_upper) continue;
            topology.triangles.push_back({t[0] - first, t[1] - first, t[2] - first});
        }
        const auto begin = pose.positions.begin() + static_cast<ptrdiff_t>(first);
        return PoseSet(topology, {{begin, begin + static_cast<ptrdiff_t>(num_lower)}}, kBlack);
    };
    const PoseSet lower = plate(false);
    StillMesh upper;
    upper.add(plate(true));
    upper.materials = of_one("phong:0.9,6");
    TransferBaker baker(bounce_options(2048, 1, 3), kBlack, upper);
    ASSERT_TRUE(baker.gloss_layout().has_value());
    const BakedPose still = baker.bake_still_mesh();
    EXPECT_EQ(still.gloss.size(), size_t{81} * num_lower);
    const BakedPose baked = baker.bake(lower.topology(), lower.load_pose(0), 0);
    EXPECT_TRUE(baked.gloss.empty());
    // Constant light 1: the plate sends its directional albedo down, which is at most 0.9. Without a
    // bounce the lower plate has what is not occluded.
    BakeOptions direct_options = bounce_options(2048, 0, 3);
    const BakedPose direct =
        TransferBaker(direct_options, kBlack, upper).bake(lower.topology(), lower.load_pose(0), 0);
    for (size_t v = 0; v < num_lower; ++v) {
        const double open = static_cast<double>(direct.transfer[v]) / kUnitY00;
        const double bounced = static_cast<double>(baked.transfer[v]) / kUnitY00 - open;
        EXPECT_GT(bounced, 0.3 * (1.0 - open)) << v;
        EXPECT_LT(bounced, 0.95 * (1.0 - open)) << v;
    }
}

TEST(GlossyBounces, DoNotDependOnThreads) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        const BakedPose baked =
            TransferBaker(bounce_options(64, 2, 3), octopus.albedo(), {}, of_one("phong:0.7,20"))
                .bake(octopus.topology(), octopus.load_pose(0), 0);
        return std::pair(baked.transfer, baked.gloss);
    };
    EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace paim
