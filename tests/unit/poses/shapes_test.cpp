// Shapes: they are what their closed forms stand for, in every pose.
#include "poses/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "paim/base/error.h"
#include "paim/mesh/normals.h"
#include "poses/catalog.h"
#include "tests/unit/poses/mesh_checks.h"

namespace paim::poses {
namespace {

constexpr uint32_t kNumPoses = 5;

TEST(Shapes, HaveTheNearestCount) {
    // Between counts n and n' of neighbouring grids the nearer one is at most half the gap away:
    // about sqrt(10 V) for the sphere, less for the others; and exact where V is a grid's count.
    for (const uint32_t wanted : {50u, 642u, 1000u, 12345u}) {
        for (const CatalogEntry& entry : catalog()) {
            if (entry.name == "octopus") continue;
            const double got = entry.make(wanted)->topology().num_vertices;
            EXPECT_NEAR(got, wanted, std::sqrt(10.0 * wanted) + 5.0) << entry.name;
        }
    }
    EXPECT_EQ(make_sphere_sequence(642)->topology().num_vertices, 642u);  // 10·8² + 2
    EXPECT_EQ(make_box_sequence(602)->topology().num_vertices, 602u);     // 6·10² + 2
    EXPECT_EQ(make_plates_sequence(242)->topology().num_vertices, 242u);  // 2·11²
    EXPECT_EQ(make_bowl_sequence(331)->topology().num_vertices, 331u);    // 3·10² + 30 + 1
}

TEST(Shapes, RefuseSizesOutOfRange) {
    for (const CatalogEntry& entry : catalog()) {
        EXPECT_THROW(entry.make(entry.min_vertices - 1), Error) << entry.name;
        EXPECT_THROW(entry.make(entry.max_vertices + 1), Error) << entry.name;
    }
}

TEST(Sphere, IsAClosedSphereInEveryPose) {
    const auto sphere = make_sphere_sequence(2562);
    EXPECT_EQ(count_bad_edges(sphere->topology()), 0);
    EXPECT_EQ(euler_characteristic(sphere->topology()), 2);
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const auto positions = sphere->positions(p, kNumPoses);
        const double radius = pulsing_radius(p, kNumPoses);
        for (const Vec3f& x : positions) EXPECT_NEAR(x.norm(), radius, 1e-6);  // float rounding
        // An equilateral face of circumradius c lies 3c²/8 below the unit sphere on average; with
        // F of them c² = 16π / (3√3 F), and the volume lost is 6π / (√3 F) = 0.21 %.
        const double volume = 4.0 / 3.0 * kPi * std::pow(radius, 3);
        EXPECT_NEAR(signed_volume(sphere->topology(), positions), volume, 0.0025 * volume);
        EXPECT_GT(worst_quality(sphere->topology(), positions), 0.8);
    }
}

TEST(Box, IsAClosedCubeInEveryPose) {
    const auto box = make_box_sequence(602);
    EXPECT_EQ(count_bad_edges(box->topology()), 0);
    EXPECT_EQ(euler_characteristic(box->topology()), 2);
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const auto positions = box->positions(p, kNumPoses);
        EXPECT_NEAR(signed_volume(box->topology(), positions), 8.0, 1e-5);  // float rounding
    }
    EXPECT_NE(box->positions(0, kNumPoses), box->positions(1, kNumPoses));
}

TEST(Cavity, IsTheCubeInsideOut) {
    const auto cavity = make_cavity_sequence(602);
    EXPECT_EQ(count_bad_edges(cavity->topology()), 0);
    EXPECT_EQ(euler_characteristic(cavity->topology()), 2);
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const auto positions = cavity->positions(p, kNumPoses);
        EXPECT_NEAR(signed_volume(cavity->topology(), positions), -8.0, 1e-5);
    }
}

TEST(Plates, FaceEachOtherAtTheirDistance) {
    const auto plates = make_plates_sequence(242);
    EXPECT_EQ(count_components(plates->topology()), 2u);
    for (uint32_t p = 0; p < kNumPoses; ++p) {
        const auto positions = plates->positions(p, kNumPoses);
        const auto normals = vertex_normals(plates->topology(), positions);
        const auto half = static_cast<float>(0.5 * plates_distance(p, kNumPoses));
        for (size_t v = 0; v < positions.size(); ++v) {
            EXPECT_FLOAT_EQ(std::abs(positions[v].y()), half);
            EXPECT_EQ(normals[v].y(), positions[v].y() < 0.0f ? 1.0f : -1.0f);
            EXPECT_LE(std::abs(positions[v].x()), 1.0f);
            EXPECT_LE(std::abs(positions[v].z()), 1.0f);
        }
    }
}

TEST(PlatesBlocked, AgreesWithASumOverThePlate) {
    for (const double distance : {0.5, 1.0, 1.5}) {
        for (const auto& [x, z] : {std::pair{0.0, 0.0}, {0.3, -0.8}, {1.0, 1.0}}) {
            constexpr int kNumCells = 400;
            constexpr double kSide = 2.0 / kNumCells;
            double sum = 0.0;
            for (int i = 0; i < kNumCells; ++i) {
                for (int j = 0; j < kNumCells; ++j) {
                    const double dx = (i + 0.5) * kSide - 1.0 - x, dz = (j + 0.5) * kSide - 1.0 - z;
                    const double squared = dx * dx + dz * dz + distance * distance;
                    sum += distance * distance / (kPi * squared * squared) * kSide * kSide;
                }
            }
            // Midpoint rule: h²/24 times second derivatives, which integrate to below 10/d².
            EXPECT_NEAR(plates_blocked(x, z, distance), sum, 5e-5);
        }
    }
    EXPECT_NEAR(plates_blocked(0.0, 0.0, 1e-6), 1.0, 1e-5);
}

// Cosine-weighted share of the half-space about `normal` that a triangle hides, signed: positive
// for a triangle counter-clockwise from the point. Lambert, Photometria, 1760.
double triangle_factor(const Vec3d& point, const Vec3d& normal, const std::array<Vec3d, 3>& t) {
    double sum = 0.0;
    for (size_t i = 0; i < 3; ++i) {
        const Vec3d a = (t[i] - point).normalized(), b = (t[(i + 1) % 3] - point).normalized();
        const Vec3d axis = a.cross(b);
        sum += std::atan2(axis.norm(), a.dot(b)) * normal.dot(axis.normalized());
    }
    return std::abs(sum) / (2.0 * kPi);
}

TEST(Bowl, HidesHalfOfEveryVertexSky) {
    const auto bowl = make_bowl_sequence(1261);  // 20 rings
    const auto& topology = bowl->topology();
    for (const uint32_t p : {0u, 1u}) {
        const auto positions = bowl->positions(p, kNumPoses);
        const double radius = pulsing_radius(p, kNumPoses);
        for (const Vec3f& x : positions) {
            EXPECT_NEAR(x.norm(), radius, 1e-6);
            EXPECT_LE(x.y(), 0.0f);
        }
        const auto normals = vertex_normals(topology, positions);
        EXPECT_LT((normals[0] - Vec3f::UnitY()).norm(), 1e-5f);  // the bottom looks up
        for (uint32_t v = 0; v < topology.num_vertices; v += 97) {
            const Vec3d point = positions[v].cast<double>(), inwards = -point.normalized();
            double hidden = 0.0;
            for (const Triangle& t : topology.triangles) {
                if (std::find(t.begin(), t.end(), v) != t.end()) continue;
                hidden +=
                    triangle_factor(point, inwards,
                                    {positions[t[0]].cast<double>(), positions[t[1]].cast<double>(),
                                     positions[t[2]].cast<double>()});
            }
            // Left out are up to six faces of 2400, each of 1/4800 of the sphere: 1.3e-3; faces lie
            // inside the sphere by (π/40)²/4, which changes angles of view by as much: 1.5e-3.
            EXPECT_NEAR(hidden, 0.5, 4e-3) << "vertex " << v;
        }
    }
}

}  // namespace
}  // namespace paim::poses
