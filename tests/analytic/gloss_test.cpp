// Glossy transfer against closed forms, the diffuse transfer, and bakes of many rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "compressor/bake/transfer_baker.h"
#include "compressor/material/brdfs.h"
#include "compressor/material/exit_functions.h"
#include "paim/base/gauss_legendre.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/sh/rotate.h"
#include "poses/octopus.h"
#include "poses/shapes.h"
#include "tests/gloss_light.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

constexpr double kY00 = 0.28209479177387814;

BakeOptions make_options(uint32_t rays, uint64_t seed = 1, uint32_t in_bands = 4,
                         uint32_t out_bands = 3) {
    BakeOptions options{4, rays, seed};
    options.gloss_in_bands = in_bands;
    options.gloss_out_bands = out_bands;
    return options;
}

Materials all_of(const std::string& brdf) {
    return {{{brdf, Vec3f::Ones()}}, {1}};
}

BakedPose bake(const PoseSet& poses, const BakeOptions& options, const Materials& materials) {
    return TransferBaker(options, poses.albedo(), {}, materials)
        .bake(poses.topology(), poses.load_pose(0), 0);
}

// A third BRDF, which the library does not know, gives the diffuse transfer from the same rays.
TEST(GlossyTransfer, OfALambertianSurfaceIsTheDiffuseTransfer) {
    add_lambertian();
    const PoseSet octopus = poses::make_octopus(1000, 1);
    for (const SamplerKind sampler :
         {SamplerKind::cosine, SamplerKind::uniform, SamplerKind::uniform_sobol}) {
        for (const double target : {0.0, 0.05}) {
            BakeOptions options = make_options(target > 0.0 ? 1024 : 64, 1, 4, 1);
            options.sampler = sampler;
            options.transfer_error = target;
            const BakedPose baked = bake(octopus, options, all_of("lambertian:1"));
            ASSERT_EQ(baked.gloss.size(), baked.transfer.size());
            double noise = 0.0;
            for (size_t r = 0; r < baked.gloss.size(); ++r) {
                // Sums of floats of at most 1, and e_o, which is 2e-6 from a constant.
                ASSERT_NEAR(kY00 * static_cast<double>(baked.gloss[r]), baked.transfer[r], 4e-6);
                ASSERT_NEAR(kY00 * static_cast<double>(baked.gloss_noise[r]), baked.noise[r], 4e-6);
                noise += std::abs(static_cast<double>(baked.noise[r]));
            }
            EXPECT_GT(noise, 0.0);
        }
    }
}

TEST(GlossyTransfer, LeavesTheDiffuseTransferAsItIs) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const BakedPose matte = bake(octopus, make_options(64), {});
    const BakedPose glossy = bake(octopus, make_options(64), all_of("phong:0.5,10"));
    EXPECT_TRUE(matte.gloss.empty());
    EXPECT_EQ(glossy.transfer, matte.transfer);
    EXPECT_EQ(glossy.noise, matte.noise);
}

// Rows of some glossy vertices are those of all, and rows of matte vertices are zero.
TEST(GlossyTransfer, HasRowsWhereFacesAreGlossy) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    Materials some = all_of("phong:0.5,10");
    some.glossy.push_back({"cook-torrance:0.5,0.5", Vec3f(1, 0.5f, 0.5f)});
    some.of_vertex.assign(octopus.topology().num_vertices, 0);
    for (uint32_t v = 0; v < 100; ++v) some.of_vertex[v] = 1;
    for (uint32_t v = 100; v < 200; ++v) some.of_vertex[v] = 2;
    const std::vector<uint32_t> rows = glossy_rows(octopus.topology(), some);
    ASSERT_LT(rows.size(), size_t{octopus.topology().num_vertices});
    const BakedPose baked = bake(octopus, make_options(64), some);
    const BakedPose first = bake(octopus, make_options(64), all_of("phong:0.5,10"));
    const BakedPose second = bake(octopus, make_options(64), all_of("cook-torrance:0.5,0.5"));
    const size_t num_vertices = octopus.topology().num_vertices;
    const size_t num_planes = first.gloss.size() / num_vertices;
    ASSERT_EQ(baked.gloss.size(), num_planes * rows.size());
    size_t num_matte = 0;
    for (size_t r = 0; r < rows.size(); ++r) {
        const uint16_t material = some.of_vertex[rows[r]];
        num_matte += material == 0;
        for (size_t plane = 0; plane < num_planes; ++plane) {
            const size_t of_all = plane * num_vertices + rows[r];
            const float expected = material == 0   ? 0.0f
                                   : material == 1 ? first.gloss[of_all]
                                                   : second.gloss[of_all];
            ASSERT_EQ(baked.gloss[plane * rows.size() + r], expected);
        }
    }
    EXPECT_GT(num_matte, 0u);
}

// In constant light an open vertex shows the share of light that it reflects, a(θ), as far as the
// bands of outgoing radiance go: Σ over even l of 2 ∫ a y_l0 dv · y_l0(v).
TEST(GlossyTransfer, OpenSphereInAWhiteFurnaceShowsTheDirectionalAlbedo) {
    const PoseSet sphere = poses::make_pose_set(*poses::make_sphere_sequence(300), 1);
    const Pose pose = sphere.load_pose(0);
    for (const char* brdf : {"phong:0.8,8", "cook-torrance:0.3,0.7"}) {
        const ExitFunctions functions(*parse_brdf(brdf), 1);
        for (const uint32_t out_bands : {3u, 6u}) {
            const BakeOptions options = make_options(64, 1, 3, out_bands);
            const BakedPose baked = bake(sphere, options, all_of(brdf));
            const TransferLayout layout{TransferKind::glossy_in_pose, 3, 1, out_bands};
            std::vector<double> light(9, 0.0);
            light[0] = 1.0 / kY00;
            std::vector<double> zonal(out_bands, 0.0), basis(size_t{out_bands} * out_bands);
            for (const auto& [z, weight] : gauss_legendre(200, 0.0, 1.0)) {
                sh::evaluate_basis(static_cast<int>(out_bands), {std::sqrt(1.0 - z * z), 0, z},
                                   std::span(basis));
                for (uint32_t l = 0; l < out_bands; l += 2) {
                    zonal[l] += 4.0 * kPi * weight * functions.albedo(z) * basis[l * (l + 1)];
                }
            }
            double worst_truncation = 0.0;
            for (size_t v = 0; v < pose.normals.size(); v += 17) {
                EXPECT_EQ(baked.gloss_noise[v], 0.0f);  // all rays are open
                for (const double z : {1.0, 0.7, 0.4, 0.1}) {
                    // A view at this angle from the normal.
                    const Vec3d n = pose.normals[v].cast<double>().normalized();
                    const Vec3d view = z * n + std::sqrt(1.0 - z * z) * n.unitOrthogonal();
                    sh::evaluate_basis(static_cast<int>(out_bands), {std::sqrt(1.0 - z * z), 0, z},
                                       std::span(basis));
                    double expected = 0.0;
                    for (uint32_t l = 0; l < out_bands; l += 2) {
                        expected += zonal[l] * basis[l * (l + 1)];
                    }
                    // Tables are 1e-4 from the truth, in six bands.
                    EXPECT_NEAR(gloss_radiance(layout, baked.gloss, v, light, view), expected, 4e-4)
                        << brdf << " at " << z;
                    worst_truncation =
                        std::max(worst_truncation, std::abs(expected - functions.albedo(z)));
                }
            }
            RecordProperty(std::string(brdf) + "_" + std::to_string(out_bands),
                           std::to_string(worst_truncation));
        }
    }
}

// A mesh that is turned has the transfer that is turned on both sides. All vertices are open, so that
// rays do not matter.
TEST(GlossyTransfer, TurnsWithTheMesh) {
    const PoseSet sphere = poses::make_pose_set(*poses::make_sphere_sequence(300), 1);
    const Eigen::AngleAxisd turn(1.1, Vec3d(1, -2, 0.5).normalized());
    const Pose pose = sphere.load_pose(0);
    Pose turned = pose;
    for (Vec3f& x : turned.positions) x = (turn * x.cast<double>()).cast<float>();
    for (Vec3f& n : turned.normals) n = (turn * n.cast<double>()).normalized().cast<float>();
    const TransferBaker baker(make_options(64), {}, {}, all_of("phong:0.6,9"));
    const BakedPose before = baker.bake(sphere.topology(), pose, 0);
    const BakedPose after = baker.bake(sphere.topology(), turned, 0);
    const TransferLayout layout = *baker.gloss_layout();
    const sh::Rotation light_rotation(4, turn.toRotationMatrix());
    RandomStream random(3);
    std::vector<double> light(16), turned_light(16);
    for (double& value : light) value = 2.0 * random.uniform() - 1.0;
    light_rotation.apply(std::span<const double>(light), std::span(turned_light));
    for (size_t v = 0; v < pose.normals.size(); v += 7) {
        const Vec3d view = Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, 0.3).normalized();
        // Normals are rounded to float: 1e-7 times the slope of the largest band.
        EXPECT_NEAR(gloss_radiance(layout, after.gloss, v, turned_light, turn * view),
                    gloss_radiance(layout, before.gloss, v, light, view), 5e-6);
    }
}

// One number of each vertex: the radiance towards a random view in random light.
std::vector<double> samples(const TransferLayout& layout, const std::vector<float>& planes) {
    const size_t num_rows = planes.size() / layout.num_planes();
    RandomStream random(11);
    std::vector<double> light(layout.num_coefficients()), radiance;
    for (size_t r = 0; r < num_rows; ++r) {
        for (double& value : light) value = 2.0 * random.uniform() - 1.0;
        const Vec3d view =
            Vec3d(random.uniform() - 0.5, random.uniform() - 0.5, random.uniform() - 0.5)
                .normalized();
        radiance.push_back(gloss_radiance(layout, planes, r, light, view));
    }
    return radiance;
}

double energy(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (size_t r = 0; r < a.size(); ++r) sum += (a[r] - b[r]) * (a[r] - b[r]);
    return sum;
}

// The mean over seeds has 1/seeds of the squared error of one. A bias would stay.
TEST(GlossyTransfer, IsUnbiased) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    for (const char* brdf : {"phong:0.7,20", "cook-torrance:0.4,0.5"}) {
        const Materials materials = all_of(brdf);
        const TransferBaker many(make_options(1 << 13, 1000), {}, {}, materials);
        const TransferLayout layout = *many.gloss_layout();
        const std::vector<double> truth =
            samples(layout, many.bake(octopus.topology(), octopus.load_pose(0), 0).gloss);
        constexpr size_t kSeeds = 24;
        std::vector<double> mean(truth.size(), 0.0);
        double single = 0.0, noise = 0.0;
        for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
            const BakedPose baked = bake(octopus, make_options(32, seed), materials);
            const std::vector<double> one = samples(layout, baked.gloss);
            for (size_t r = 0; r < one.size(); ++r) mean[r] += one[r] / kSeeds;
            single += energy(one, truth) / kSeeds;
            noise +=
                energy(samples(layout, baked.gloss_noise), std::vector<double>(one.size(), 0.0)) /
                kSeeds;
        }
        // The truth has (32 / 8192)^1.5 of the squared error of one bake. The ratio is a mean over
        // some 1000 vertices, whose squared errors differ a lot: as many as 100 of the same size,
        // each of them χ² with one degree of freedom, √(2 / 100) = 0.14.
        const double ratio = energy(mean, truth) / (single / kSeeds);
        RecordProperty(std::string(brdf) + "_ratio", std::to_string(ratio));
        EXPECT_NEAR(ratio, 1.0, 0.5) << brdf;
        // Noise has the variance of the error. r is that of diffuse transfer, 1.42 for 32 rays, and
        // may differ for narrower lobes, whose halves differ more where light changes smoothly.
        RecordProperty(std::string(brdf) + "_noise", std::to_string(std::sqrt(noise / single)));
        EXPECT_NEAR(std::sqrt(noise / single), 1.0, 0.15) << brdf;
    }
}

TEST(GlossyTransfer, DoesNotDependOnThreads) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        const BakedPose baked = bake(octopus, make_options(64), all_of("phong:0.7,20"));
        return std::pair(baked.gloss, baked.gloss_noise);
    };
    EXPECT_EQ(run(1), run(2));
}

TEST(GlossyTransfer, BandsAreThoseOfTheMaterialThatNeedsMost) {
    Materials materials = all_of("phong:0.5,1");
    BakeOptions options;
    const auto layout_of = [&] { return *TransferBaker::gloss_layout(options, {}, {}, materials); };
    const TransferLayout wide = layout_of();
    materials.glossy.push_back({"phong:0.5,500", Vec3f::Ones()});
    const TransferLayout narrow = layout_of();
    EXPECT_LT(wide.in_bands, narrow.in_bands);
    EXPECT_LT(wide.out_bands, narrow.out_bands);
    EXPECT_EQ(narrow.channels, 1u);
    options.gloss_in_bands = 3;
    EXPECT_EQ(layout_of().in_bands, 3u);
    EXPECT_EQ(layout_of().out_bands, narrow.out_bands);
    // A coloured tint matters if light bounces.
    materials.glossy[0].tint = Vec3f(1, 0.5f, 0.5f);
    EXPECT_EQ(layout_of().channels, 1u);
    options.bounces = 1;
    EXPECT_EQ(layout_of().channels, 3u);
    EXPECT_FALSE(TransferBaker::gloss_layout(options, {}, {}, {}).has_value());
}

}  // namespace
}  // namespace paim
