// Bounds of animations.
#include "paim/codec/sequence_bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "paim/codec/svd/svd_transfer.h"
#include "paim/mesh/planes.h"

namespace paim {
namespace {

// Two vertices; component 0 moves the second along x, component 1 the first along z.
Asset moving_points(uint32_t num_poses) {
    Asset asset;
    CodedMesh& mesh = asset.moving();
    mesh.topology.num_vertices = 2;
    mesh.layout.in_bands = 1;
    LowRank& positions = mesh.positions;
    positions.num_points = 2;
    positions.num_planes = 3;
    positions.num_poses = num_poses;
    positions.num_components = 2;
    positions.mean = std::vector<float>{0, 1, 0, 2, 0, 3};  // x x y y z z
    positions.components = {std::vector<float>{0, 1, 0, 0, 0, 0},
                            std::vector<float>{0, 0, 0, 0, 1, 0}};
    for (uint32_t p = 0; p < num_poses; ++p) {
        positions.weights.push_back(static_cast<float>(p));
    }
    for (uint32_t p = 0; p < num_poses; ++p) {
        positions.weights.push_back(p == 1 ? -4.0f : 0.0f);
    }
    LowRank transfer;
    transfer.num_points = 2;
    transfer.num_planes = 1;
    transfer.num_poses = num_poses;
    transfer.mean = std::vector<float>{0, 0};
    mesh.transfer = SvdTransfer(std::move(transfer));
    return asset;
}

TEST(PoseBounds, AreThoseOfTheDecodedPositions) {
    const Asset asset = moving_points(3);
    Bounds bounds = pose_bounds(asset, 1.0, 2);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -4));
    EXPECT_EQ(bounds.upper, Vec3f(2, 2, 3));
    bounds = pose_bounds(asset, 1.5, 2);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -2));
    EXPECT_EQ(bounds.upper, Vec3f(2.5f, 2, 3));
    bounds = pose_bounds(asset, 1.0, 1);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, 0));
    bounds = pose_bounds(asset, 1.0, 0);
    EXPECT_EQ(bounds.upper, Vec3f(1, 2, 3));
}

// Points of no face are not seen, once there are faces.
TEST(PoseBounds, AreThoseOfVerticesOfFaces) {
    Asset asset = moving_points(3);
    asset.moving().topology.triangles = {{1, 1, 1}};
    EXPECT_EQ(pose_bounds(asset, 0.0, 2).lower, Vec3f(1, 2, 3));
    EXPECT_EQ(sequence_bounds(asset).lower, Vec3f(1, 2, 3));
    EXPECT_EQ(sequence_bounds(asset).upper, Vec3f(3, 2, 3));
    Asset still = moving_points(1);
    still.moving().topology.triangles = {{1, 1, 1}};
    asset.parts.push_back(still.moving());
    asset.parts[1].positions = LowRank::still(3, std::vector<float>{-2, 0, 0, 0, 0, 0});
    // As far as the diagonal, 2, below the moving vertex. Without faces x would be -1.
    EXPECT_EQ(sequence_bounds(asset).lower, Vec3f(0, 0, 1));
}

TEST(SequenceBounds, HoldEveryPose) {
    const Bounds bounds = sequence_bounds(moving_points(5));
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -4));
    EXPECT_EQ(bounds.upper, Vec3f(5, 2, 3));
    const Bounds single = sequence_bounds(moving_points(1));
    EXPECT_EQ(single.lower, Vec3f(0, 0, 0));
    EXPECT_EQ(single.upper, Vec3f(1, 2, 3));
}

// The poses that count: those whose vertex shows in the bounds when it alone is far away.
std::vector<uint32_t> sampled_poses(uint32_t num_poses, uint64_t max_multiply_adds) {
    std::vector<uint32_t> sampled;
    for (uint32_t p = 0; p < num_poses; ++p) {
        Asset asset = moving_points(num_poses);
        asset.moving().positions.weights[p] = 99.0f;
        if (sequence_bounds(asset, max_multiply_adds).upper.x() == 100.0f) sampled.push_back(p);
    }
    return sampled;
}

// A pose of moving_points() takes 3 planes · 2 points · (1 mean + 2 components) = 18 multiply-adds.
TEST(SequenceBounds, SampleWhatTakesMoreThanTheLimit) {
    using Poses = std::vector<uint32_t>;
    EXPECT_EQ(sampled_poses(6, 6 * 18), (Poses{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(sampled_poses(6, 6 * 18 - 1), (Poses{0, 2, 4, 5}));
    EXPECT_EQ(sampled_poses(6, 3 * 18), (Poses{0, 2, 4, 5}));
    EXPECT_EQ(sampled_poses(6, 3 * 18 - 1), (Poses{0, 3, 5}));
    // Two samples and the last pose, however small the limit.
    EXPECT_EQ(sampled_poses(6, 0), (Poses{0, 3, 5}));
    EXPECT_EQ(sampled_poses(2, 0), (Poses{0, 1}));
    EXPECT_EQ(sampled_poses(1, 0), (Poses{0}));
}

TEST(SequenceBounds, HoldWhatStandsStillNearBy) {
    Asset asset = moving_points(1);  // from the origin to (1, 2, 3), diagonal √14
    asset.parts.emplace_back().topology.num_vertices = 1;
    const auto stand_at = [&](float x) {
        asset.still()->positions = LowRank::still(3, std::vector<float>{x, 1, 1});
    };
    const float reach = std::sqrt(14.0f);
    stand_at(-2);
    EXPECT_EQ(sequence_bounds(asset).lower, Vec3f(-2, 0, 0));
    EXPECT_EQ(sequence_bounds(asset).upper, Vec3f(1, 2, 3));
    EXPECT_EQ(pose_bounds(asset, 0.0, 2).lower, Vec3f(-2, 0, 0));
    stand_at(1e30f);  // framed as far as one diagonal, seen as far as 500
    EXPECT_FLOAT_EQ(sequence_bounds(asset).upper.x(), 1 + reach);
    EXPECT_FLOAT_EQ(pose_bounds(asset, 0.0, 2).upper.x(), 1 + 500 * reach);
    stand_at(400);
    EXPECT_EQ(pose_bounds(asset, 0.0, 2).upper, Vec3f(400, 2, 3));
    Bounds still;
    still.extend(from_planes(asset.still()->positions.mean_floats()));
    EXPECT_EQ(framed_bounds(Bounds(), still).upper, Vec3f(400, 1, 1));
}

TEST(SequenceBounds, OfNothingAreEmpty) {
    Asset asset = moving_points(3);
    asset.moving().topology.num_vertices = 0;
    for (LowRank* matrix : {&asset.moving().positions, &asset.moving().transfer->matrix}) {
        matrix->num_points = 0;
        matrix->mean = {};
        matrix->components.clear();
    }
    EXPECT_TRUE(sequence_bounds(asset).empty());
}

}  // namespace
}  // namespace paim
