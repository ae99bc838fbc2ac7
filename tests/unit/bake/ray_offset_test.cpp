// Where shadow rays start: the rule itself, surfaces that must not shadow themselves, and those
// that must not leak.
#include "compressor/bake/ray_offset.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compressor/bake/transfer_baker.h"
#include "paim/base/seed.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/pose_set.h"
#include "paim/trace/ray_scene.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim {
namespace {

using poses::make_cavity_sequence;
using poses::make_sphere_sequence;

PoseStatistics bake(const PoseSet& set, uint32_t rays) {
    return TransferBaker({1, rays, 5}).bake(set.topology(), set.load_pose(0), 0).statistics;
}

PoseSet mapped(const poses::Sequence& sequence, const Eigen::Affine3f& map) {
    std::vector<Vec3f> positions = sequence.positions(0, 1);
    for (Vec3f& x : positions) x = map * x;
    return {sequence.topology(), {positions}};
}

Eigen::Affine3f scaling(const Vec3f& factors) {
    return Eigen::Affine3f(Eigen::Scaling(factors));
}

TEST(RayOffset, IsOfTheShortestEdgeAndAboveRounding) {
    const Topology topology{6, {{0, 1, 2}, {1, 3, 2}, {0, 4, 0}, {1, 3, 5}}};
    // Edges 3, 4, 5 round vertex 0; vertex 4 has no area, and 5 lies on the line of 1 and 3.
    const std::vector<Vec3f> corners{{0, 0, 0}, {3, 0, 0}, {0, 4, 0},
                                     {3, 4, 0}, {1, 0, 0}, {3, 1, 0}};
    const auto offsets = ray_offsets(topology, corners, {1e-2, 0.0});
    EXPECT_FLOAT_EQ(offsets[0], 0.03f);
    EXPECT_FLOAT_EQ(offsets[1], 0.03f);
    EXPECT_FLOAT_EQ(offsets[2], 0.03f);
    EXPECT_EQ(offsets[4], 0.0f);
    EXPECT_EQ(offsets[5], 0.0f);
    // At the origin too, the largest coordinate is that of the faces.
    for (const float offset : {ray_offsets(topology, corners, {0.0, 1.0})[0],
                               ray_offsets(topology, corners, {0.0, 1.0})[3]}) {
        EXPECT_FLOAT_EQ(offset, 0x1p-21f);
    }
}

TEST(RayOffset, ScalesExactlyAndDoesNotDependOnFacesThatAreThereTwice) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    std::vector<Vec3f> positions = octopus.load_pose(0).positions;
    const auto offsets = ray_offsets(octopus.topology(), positions);
    Topology twice = octopus.topology();
    twice.triangles.insert(twice.triangles.end(), twice.triangles.rbegin(), twice.triangles.rend());
    EXPECT_EQ(ray_offsets(twice, positions), offsets);
    for (Vec3f& x : positions) x *= 0x1p40f;
    const auto scaled = ray_offsets(octopus.topology(), positions);
    for (size_t v = 0; v < scaled.size(); ++v) EXPECT_EQ(scaled[v], 0x1p40f * offsets[v]);
}

TEST(RayOffset, ConvexMeshesDoNotShadowThemselves) {
    // No direction above the tangent plane of an averaged normal meets a convex mesh again.
    for (const uint32_t num_vertices : {50u, 162u, 642u, 2562u, 10242u}) {
        const auto sphere = make_sphere_sequence(num_vertices);
        const uint32_t rays = 2 * (500'000 / num_vertices);
        for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
            const PoseSet scaled = mapped(*sphere, scaling(Vec3f::Constant(scale)));
            EXPECT_EQ(bake(scaled, rays).occluded, 0u) << num_vertices << ' ' << scale;
        }
    }
}

TEST(RayOffset, SquashedAndStretchedSpheresDoNotShadowThemselves) {
    const auto sphere = make_sphere_sequence(642);
    RandomStream random(8);
    for (const Vec3f& factors : {Vec3f(1, 1e-1f, 1), Vec3f(1, 1e-2f, 1), Vec3f(1e-3f, 1, 1),
                                 Vec3f(1, 1e-2f, 1e-2f), Vec3f(1e2f, 1, 1e-2f)}) {
        for (int j = 0; j < 4; ++j) {
            const auto uniform = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
            const Eigen::AngleAxisf turn(3.0f * uniform(),
                                         Vec3f(uniform(), uniform(), uniform()).normalized());
            const PoseSet squashed = mapped(*sphere, turn * scaling(factors));
            const PoseStatistics statistics = bake(squashed, 512);
            // Turned, its corners are rounded by 2^-24 of the longest axis, which dents the thin
            // directions of the mesh: a few grazing rays are occluded rightly. Far below the 0.1 %
            // that are allowed.
            EXPECT_LE(static_cast<double>(statistics.occluded),
                      1e-4 * static_cast<double>(statistics.rays))
                << factors.transpose() << ", turn " << j;
        }
        EXPECT_EQ(bake(mapped(*sphere, scaling(factors)), 512).occluded, 0u) << factors.transpose();
    }
}

TEST(RayOffset, SpheresAsFarOutAsFloatsCarryThemDoNotShadowThemselves) {
    // 15 diameters out (beyond 16 positions are counted from elsewhere), rounding dents the sphere
    // by 2^-20 of its size, against sagittas of 1/100 to 1/4000.
    for (const uint32_t num_vertices : {162u, 2562u}) {
        const auto sphere = make_sphere_sequence(num_vertices);
        for (const Vec3f& far : {Vec3f(30, 0, 0), Vec3f(-17, 17, 18)}) {
            const PoseSet moved = mapped(*sphere, Eigen::Affine3f(Eigen::Translation3f(far)));
            EXPECT_EQ(bake(moved, 1024).occluded, 0u) << num_vertices;
        }
    }
}

TEST(RayOffset, NoRayLeavesAClosedCavity) {
    for (const uint32_t num_vertices : {50u, 1000u, 10000u}) {
        const auto cavity = make_cavity_sequence(num_vertices);
        for (const float scale : {1e-6f, 1.0f, 1e6f}) {
            for (const float distance : {0.0f, 30.0f}) {
                Eigen::Affine3f map = scaling(Vec3f(scale, 1e-2f * scale, scale));
                map = Eigen::AngleAxisf(1.0f, Vec3f(0.3f, -0.5f, 0.81f).normalized()) * map;
                map = Eigen::Translation3f(Vec3f::Constant(distance * scale)) * map;
                const PoseStatistics statistics = bake(mapped(*cavity, map), 256);
                EXPECT_EQ(statistics.occluded, statistics.rays) << num_vertices << ' ' << scale;
                EXPECT_EQ(statistics.zero_normals, 0u);
            }
        }
    }
}

TEST(RayOffset, CreasesNeitherLeakNorShadow) {
    // The bottom of a groove between two walls, in any direction. A ray above both walls is open
    // and one below either is occluded, but for rays so flat that they start above the wall's far
    // end: from a height of 1e-4 edges, flatter than 1e-4.
    constexpr double kFlat = 1.1e-4;
    RandomStream random(2);
    const auto uniform = [&] { return 2.0 * random.uniform() - 1.0; };
    uint64_t num_open = 0, num_occluded = 0;
    for (const double opening_deg : {170.0, 90.0, 30.0, 5.0, 1.0}) {
        const double half = 0.5 * opening_deg * kPi / 180.0;
        const Vec3d left(-std::sin(half), std::cos(half), 0.0),
            right(std::sin(half), std::cos(half), 0.0);
        const Vec3d along(0, 0, 1);
        const Vec3d left_normal =
            along.cross(left).cwiseProduct(Vec3d(-1, -1, 1));  // into the groove
        const Vec3d right_normal = right.cross(along).cwiseProduct(Vec3d(-1, -1, 1));
        // Crease vertices 0 to 4; each wall reaches one unit up.
        Topology topology{15, {}};
        std::vector<Vec3d> points;
        for (const Vec3d& up : {Vec3d(0, 0, 0), left, right}) {
            for (int i = -2; i <= 2; ++i) points.push_back(up + i * along);
        }
        for (uint32_t i = 0; i < 4; ++i) {
            topology.triangles.push_back({i, i + 6, i + 1});
            topology.triangles.push_back({i, i + 5, i + 6});
            topology.triangles.push_back({i, i + 1, i + 11});
            topology.triangles.push_back({i, i + 11, i + 10});
        }
        const Eigen::Matrix3d turn =
            Eigen::AngleAxisd(2.0 * uniform(), Vec3d(uniform(), uniform(), uniform()).normalized())
                .toRotationMatrix();
        std::vector<Vec3f> positions;
        for (const Vec3d& x : points) positions.push_back((turn * x).cast<float>());
        const Pose pose = PoseSet(topology, {positions}).load_pose(0);
        const Vec3d bisector = turn * Vec3d(0, 1, 0);
        ASSERT_GT(pose.normals[2].cast<double>().dot(bisector), 0.999);
        const RayScene scene(topology, positions);
        const Vec3f start = positions[2] + ray_offsets(topology, positions)[2] * pose.normals[2];
        for (int j = 0; j < 20000; ++j) {
            const Vec3d sphere = Vec3d(uniform(), uniform(), uniform());
            if (sphere.squaredNorm() > 1.0 || sphere.squaredNorm() < 0.01) continue;
            const Vec3d d = (bisector + sphere.normalized()).normalized();
            const Vec3d here = turn.transpose() * d;
            const double above = std::min(here.dot(left_normal), here.dot(right_normal));
            if (std::abs(above) < kFlat) continue;
            const Vec3f direction = d.cast<float>();
            float occluded = 0.0f;
            scene.occluded(start, &direction.x(), &direction.y(), &direction.z(), 1, &occluded);
            ASSERT_EQ(occluded, above > 0.0 ? 0.0f : 1.0f) << opening_deg << ' ' << above;
            ++(above > 0.0 ? num_open : num_occluded);
        }
    }
    EXPECT_GT(num_open, 10000u);
    EXPECT_GT(num_occluded, 10000u);
}

}  // namespace
}  // namespace paim
