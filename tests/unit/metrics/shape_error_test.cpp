// Errors of shape: closed forms, what they do not see, and small pieces that large ones do not hide.
#include "paim/metrics/shape_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "paim/base/tbb_parallel.h"
#include "paim/base/vector.h"
#include "paim/mesh/planes.h"
#include "poses/octopus.h"

namespace paim {
namespace {

using Positions = std::vector<Vec3f>;

PieceShapeError measure(const Topology& topology, const std::vector<Positions>& decoded,
                        const std::vector<Positions>& baked) {
    const ShapeNeighbours neighbours(topology);
    ShapeErrorMeter meter(neighbours);
    std::vector<ShapeErrorMeter::Pose> poses;
    for (size_t p = 0; p < baked.size(); ++p) {
        poses.push_back({to_planes(decoded[p]), to_planes(baked[p])});
    }
    meter.add(poses);
    return meter.result();
}

const Topology kTriangle{3, {{0, 1, 2}}};
const Positions kRight{{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};

TEST(ShapeError, OfOneTriangleIsKnown) {
    // The edges of 3, 4 and 5 become 3, 2 and √13.
    const Positions decoded{{0, 0, 0}, {3, 0, 0}, {0, 2, 0}};
    const double of_5 = (5.0 - std::sqrt(13.0)) / 5.0;
    const auto deviation = [](double a, double of_a, double b, double of_b) {
        // Two values of weights a and b.
        return std::sqrt(a * b) / (a + b) * std::abs(of_a - of_b);
    };
    const double expected =
        (deviation(3, 0.0, 4, 0.5) + deviation(3, 0.0, 5, of_5) + deviation(4, 0.5, 5, of_5)) / 3.0;
    const PieceShapeError error = measure(kTriangle, {decoded}, {kRight});
    EXPECT_NEAR(error.whole.sted_space, expected, 1e-12);
    EXPECT_EQ(error.whole.sted_time, 0.0);
    EXPECT_NEAR(error.whole.normal_angle_deg, 0.0, 1e-12);
    EXPECT_EQ(error.worst.sted(), error.whole.sted());
}

TEST(ShapeError, OfRotationsIsTheAngle) {
    const PoseSet octopus = poses::make_octopus(1000, 3);
    std::vector<Positions> baked, turned, scaled;
    const float angle = 0.1f;
    for (uint32_t p = 0; p < 3; ++p) {
        baked.push_back(octopus.load_pose(p).positions);
        turned.emplace_back();
        scaled.emplace_back();
        for (const Vec3f& x : baked.back()) {
            turned.back().emplace_back(std::cos(angle) * x.x() - std::sin(angle) * x.y(),
                                       std::sin(angle) * x.x() + std::cos(angle) * x.y(), x.z());
            scaled.back().push_back(1.25f * x);
        }
    }
    // Normals turn by the angle, less near the axis; edges keep their lengths.
    const PieceShapeError rotation = measure(octopus.topology(), turned, baked);
    EXPECT_LT(rotation.whole.sted(), 1e-5);
    EXPECT_LT(rotation.whole.normal_angle_deg, angle * 180.0 / kPi + 1e-4);
    EXPECT_GT(rotation.whole.normal_angle_deg, 0.5 * angle * 180.0 / kPi);
    // All edges of a neighbourhood become longer by the same share.
    const PieceShapeError scaling = measure(octopus.topology(), scaled, baked);
    EXPECT_LT(scaling.whole.sted_space, 1e-5);
    EXPECT_LT(scaling.whole.normal_angle_deg, 1e-3);
}

TEST(ShapeError, OfNothingIsZero) {
    const PieceShapeError error =
        measure(kTriangle, {kRight, kRight, kRight}, {kRight, kRight, kRight});
    EXPECT_EQ(error.worst.sted(), 0.0);
    EXPECT_EQ(error.worst.normal_angle_deg, 0.0);
    EXPECT_EQ(measure(kTriangle, {}, {}).worst.sted(), 0.0);
}

// A triangle that stands still while its decoded copy jumps in the last pose. Its steps are a
// hundredth of the diagonal long in time alone: 0.05.
TEST(ShapeError, SeesWhatTrembles) {
    Positions jumped = kRight;
    for (Vec3f& x : jumped) x.x() += 0.05f;
    const PieceShapeError error =
        measure(kTriangle, {kRight, kRight, jumped}, {kRight, kRight, kRight});
    // Differences of 0 and √2 − 1, of the same weight.
    EXPECT_NEAR(error.whole.sted_time, 0.5 * (std::sqrt(2.0) - 1.0), 1e-6);
    EXPECT_NEAR(error.whole.sted_space, 0.0, 1e-6);
}

TEST(ShapeError, FacesThatLoseTheirAreaTurnByARightAngle) {
    const Positions flat{{0, 0, 0}, {3, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(measure(kTriangle, {flat}, {kRight}).whole.normal_angle_deg, 90.0);
    EXPECT_EQ(measure(kTriangle, {kRight}, {flat}).whole.normal_angle_deg, 0.0);
}

// Ten triangles that are right and one that is folded flat, each a piece.
TEST(ShapeError, OfASmallPieceIsNotHidden) {
    Topology topology{0, {}};
    Positions baked, decoded;
    for (uint32_t j = 0; j < 11; ++j) {
        topology.append(kTriangle);
        for (const Vec3f& x : kRight) {
            baked.push_back(x);
            decoded.push_back(j == 3 && x.y() > 0.0f ? Vec3f(0.0f, 0.0f, 4.0f) : x);
        }
    }
    const PieceShapeError error = measure(topology, {decoded}, {baked});
    EXPECT_NEAR(error.worst.normal_angle_deg, 90.0, 1e-9);
    EXPECT_NEAR(error.whole.normal_angle_deg, 90.0 / 11.0, 1e-9);
}

// Nor do vertices of no face hide it.
TEST(ShapeError, JudgesTheSamePiecesWithVerticesOfNoFace) {
    // Strips of 60 and 1000 vertices.
    Topology topology{1060, {}};
    for (uint32_t v = 0; v + 2 < 60; ++v) topology.triangles.push_back({v, v + 1, v + 2});
    for (uint32_t v = 60; v + 2 < 1060; ++v) topology.triangles.push_back({v, v + 1, v + 2});
    EXPECT_EQ(ShapeNeighbours(topology).judged.count, 2u);
    topology.num_vertices += 1000;
    EXPECT_EQ(ShapeNeighbours(topology).judged.count, 2u);
}

// Poses are added in pieces of every length, on any number of threads.
TEST(ShapeError, DoesNotDependOnHowPosesAreAdded) {
    const PoseSet octopus = poses::make_octopus(1000, 7);
    const ShapeNeighbours neighbours(octopus.topology());
    std::vector<ShapeErrorMeter::Pose> poses;
    for (uint32_t p = 0; p < 7; ++p) {
        const std::vector<float> baked = to_planes(octopus.load_pose(p).positions);
        std::vector<float> decoded = baked;
        for (size_t j = 0; j < decoded.size(); ++j) {
            decoded[j] += 0.01f * static_cast<float>((j * 7 + p) % 5);
        }
        poses.push_back({decoded, baked});
    }
    ShapeErrorMeter at_once(neighbours);
    at_once.add(poses);
    const PieceShapeError expected = at_once.result();
    EXPECT_GT(expected.whole.sted_time, 0.0);
    for (size_t length = 1; length < poses.size(); ++length) {
        const ThreadLimit threads(length % 2 == 0 ? 1 : 2);
        ShapeErrorMeter meter(neighbours);
        for (size_t first = 0; first < poses.size(); first += length) {
            meter.add(std::span(poses).subspan(first, std::min(length, poses.size() - first)));
        }
        EXPECT_EQ(meter.result().whole.sted_space, expected.whole.sted_space) << length;
        EXPECT_EQ(meter.result().whole.sted_time, expected.whole.sted_time) << length;
        EXPECT_EQ(meter.result().worst.normal_angle_deg, expected.worst.normal_angle_deg) << length;
    }
}

TEST(ShapeError, DoesNotDependOnTheUnit) {
    const PoseSet octopus = poses::make_octopus(1000, 3);
    PieceShapeError errors[3];
    const int exponents[] = {0, 100, -100};
    for (int j = 0; j < 3; ++j) {
        std::vector<Positions> baked, decoded;
        for (uint32_t p = 0; p < 3; ++p) {
            baked.push_back(octopus.load_pose(p).positions);
            decoded.push_back(baked.back());
            for (size_t v = 0; v < baked[p].size(); ++v) {
                decoded[p][v].x() += 0.01f * static_cast<float>((v * 7 + p) % 5);
                decoded[p][v] *= std::ldexp(1.0f, exponents[j]);
                baked[p][v] *= std::ldexp(1.0f, exponents[j]);
            }
        }
        errors[j] = measure(octopus.topology(), decoded, baked);
        EXPECT_NEAR(errors[j].whole.sted(), errors[0].whole.sted(), 1e-6);
        EXPECT_NEAR(errors[j].whole.normal_angle_deg, errors[0].whole.normal_angle_deg, 1e-6);
    }
    EXPECT_GT(errors[0].whole.sted_space, 0.01);
    EXPECT_GT(errors[0].whole.sted_time, 0.001);
}

}  // namespace
}  // namespace paim
