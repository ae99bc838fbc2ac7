// Light that bounces in a sphere with a hole, of any harmonic, for as long as it takes.
// Based on: Goebel, Generalized Integrating-Sphere Theory, 1967
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/transfer_baker.h"
#include "paim/mesh/pose_set.h"
#include "paim/sh/basis.h"
#include "tests/unit/material/lambertian.h"

namespace paim {
namespace {

// A sphere of radius 1 whose top is open, seen from within: vertices in rings from the edge of the hole
// downwards.
PoseSet sphere_with_hole(double edge_polar_rad, uint32_t num_rings, uint32_t num_segments) {
    std::vector<Vec3f> positions;
    Topology topology;
    for (uint32_t ring = 0; ring < num_rings; ++ring) {
        const double polar = edge_polar_rad + (kPi - edge_polar_rad) * ring / num_rings;
        for (uint32_t j = 0; j < num_segments; ++j) {
            // Every other ring is turned by half a step, so that triangles are alike.
            const double azimuth = 2.0 * kPi * (j + 0.5 * (ring % 2)) / num_segments;
            positions.push_back(Vec3d(std::sin(polar) * std::cos(azimuth),
                                      std::sin(polar) * std::sin(azimuth), std::cos(polar))
                                    .cast<float>());
        }
    }
    positions.push_back(-Vec3f::UnitZ());
    topology.num_vertices = static_cast<uint32_t>(positions.size());
    for (uint32_t ring = 0; ring < num_rings; ++ring) {
        for (uint32_t j = 0; j < num_segments; ++j) {
            const uint32_t first = ring * num_segments, below = first + num_segments;
            const uint32_t next = (j + 1) % num_segments;
            if (ring + 1 == num_rings) {
                topology.triangles.push_back({first + j, first + next, below});
                continue;
            }
            // The vertex of the lower ring that is below the upper edge of a cell, and that of the upper
            // ring above the lower edge.
            const uint32_t under = ring % 2 == 0 ? j : next, over = ring % 2 == 0 ? next : j;
            topology.triangles.push_back({first + j, first + next, below + under});
            topology.triangles.push_back({first + over, below + next, below + j});
        }
    }
    return PoseSet(topology, {positions});
}

// An integrating sphere. What a point of a sphere sends out by Lambert's law comes to all points of the sphere
// alike, but for the open share f, which leaves. Light of the harmonic y_i comes in through the hole, a disc of
// the area π sin²θ, as π sin²θ A_l y_i(axis), where A_l y_i is y_i through the cosine lobe (A: π, 2π/3). So the
// mean of the transfer over the whole sphere is D_i = sin²θ A_l y_i(axis) / 4π, and b bounces add
// ρ D_i (1 + q + … + q^(b−1)) at every point, with q = ρ (1 − f).
TEST(IntegratingSphere, AddsTheSameLightEverywhere) {
    add_lambertian();
    constexpr double kRho = 0.9, kCosine = 0.8;  // f = 0.1, q = 0.81: slow to converge
    const double open = 0.5 * (1.0 - kCosine), share = 0.25 * (1.0 - kCosine * kCosine);
    const PoseSet sphere = sphere_with_hole(std::acos(kCosine), 40, 64);
    const Pose pose = sphere.load_pose(0);
    const size_t num_vertices = pose.positions.size();
    const auto bake = [&](uint32_t bounces) {
        BakeOptions options{2, 128, 1};
        options.gloss_in_bands = 2;
        options.gloss_out_bands = 1;
        options.bounces = bounces;
        return TransferBaker(options, {{Vec3f::Zero()}}, {},
                             {{{"lambertian:0.9", Vec3f::Ones()}}, {1}})
            .bake(sphere.topology(), pose, 0)
            .transfer;
    };
    std::vector<double> along_axis(4);
    sh::evaluate_basis(2, Vec3d(0, 0, 1), std::span(along_axis));
    const std::vector<float> direct = bake(0);
    for (const uint32_t bounces : {1u, 3u, 8u}) {
        const std::vector<float> lit = bake(bounces);
        for (size_t i = 0; i < 4; ++i) {
            // Of the upper and of the lower half of the sphere.
            double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
            for (size_t v = 0; v < num_vertices; ++v) {
                const size_t half = pose.positions[v].z() > 0.0f;
                sums[half] += static_cast<double>(lit[i * num_vertices + v]) -
                              static_cast<double>(direct[i * num_vertices + v]);
                counts[half] += 1.0;
            }
            const double q = kRho * (1.0 - open);
            const double series = (1.0 - std::pow(q, bounces)) / (1.0 - q);
            const double expected =
                kRho * share * (i == 0 ? 1.0 : 2.0 / 3.0) * along_axis[i] * series;
            // The flat faces at a vertex are up to half an edge, 0.05, steeper than the sphere there.
            // Rays between both leave the sphere: 0.05² of them, which let in light as more of a hole.
            // 0.0025 of f, 0.1, is 2.5 % of light, and lowers q by 0.0023, so that as much as 1.2 % of
            // the series is lost. For harmonics that are not constant, that light is 0.0025 times 0.49.
            // Noise of 128 rays at 2500 vertices is below 1 %.
            const double tolerance = 0.035 * kRho * share * series * along_axis[0] +
                                     (i == 0 ? 0.0 : 0.0025 * 0.49 * kRho * series);
            for (const size_t half : {0, 1}) {
                EXPECT_NEAR(sums[half] / counts[half], expected, tolerance)
                    << bounces << " bounces, coefficient " << i << ", half " << half;
            }
        }
    }
}

}  // namespace
}  // namespace paim
