// Bounds of animations.
#include "paim/codec/sequence_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>

namespace paim {
namespace {

// Two vertices; component 0 moves the second along x, component 1 the first along z.
Asset moving_points(uint32_t num_poses) {
    Asset model;
    model.moving().topology.num_vertices = 2;
    model.moving().layout.in_bands = 1;
    model.moving().positions.num_points = 2;
    model.moving().positions.num_planes = 3;
    model.moving().positions.num_poses = num_poses;
    model.moving().positions.num_components = 2;
    model.moving().positions.mean = std::vector<float>{0, 1, 0, 2, 0, 3};  // x x y y z z
    model.moving().positions.components = {std::vector<float>{0, 1, 0, 0, 0, 0},
                                 std::vector<float>{0, 0, 0, 0, 1, 0}};
    for (uint32_t p = 0; p < num_poses; ++p) {
        model.moving().positions.weights.push_back(static_cast<float>(p));
    }
    for (uint32_t p = 0; p < num_poses; ++p) {
        model.moving().positions.weights.push_back(p == 1 ? -4.0f : 0.0f);
    }
    model.moving().transfer->matrix.num_points = 2;
    model.moving().transfer->matrix.num_planes = 1;
    model.moving().transfer->matrix.num_poses = num_poses;
    model.moving().transfer->matrix.mean = std::vector<float>{0, 0};
    return model;
}

TEST(PoseBounds, AreThoseOfTheDecodedPositions) {
    const Asset model = moving_points(3);
    Bounds bounds = pose_bounds(model, 1.0, 2);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -4));
    EXPECT_EQ(bounds.upper, Vec3f(2, 2, 3));
    bounds = pose_bounds(model, 1.5, 2);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -2));
    EXPECT_EQ(bounds.upper, Vec3f(2.5f, 2, 3));
    bounds = pose_bounds(model, 1.0, 1);
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, 0));
    bounds = pose_bounds(model, 1.0, 0);
    EXPECT_EQ(bounds.upper, Vec3f(1, 2, 3));
}

TEST(SequenceBounds, HoldEveryPose) {
    const Bounds bounds = sequence_bounds(moving_points(5));
    EXPECT_EQ(bounds.lower, Vec3f(0, 0, -4));
    EXPECT_EQ(bounds.upper, Vec3f(5, 2, 3));
    const Bounds single = sequence_bounds(moving_points(1));
    EXPECT_EQ(single.lower, Vec3f(0, 0, 0));
    EXPECT_EQ(single.upper, Vec3f(1, 2, 3));
}

TEST(SequenceBounds, HoldSceneryNearBy) {
    Asset model = moving_points(1);  // from the origin to (1, 2, 3), diagonal √14
    const auto scenery = [&](float x) {
        model.scenery.topology.num_vertices = 1;
        model.scenery.positions = std::vector<float>{x, 1, 1};
    };
    const float reach = std::sqrt(14.0f);
    scenery(-2);
    EXPECT_EQ(sequence_bounds(model).lower, Vec3f(-2, 0, 0));
    EXPECT_EQ(sequence_bounds(model).upper, Vec3f(1, 2, 3));
    EXPECT_EQ(pose_bounds(model, 0.0, 2).lower, Vec3f(-2, 0, 0));
    scenery(1e30f);  // framed as far as one diagonal, seen as far as 500
    EXPECT_FLOAT_EQ(sequence_bounds(model).upper.x(), 1 + reach);
    EXPECT_FLOAT_EQ(pose_bounds(model, 0.0, 2).upper.x(), 1 + 500 * reach);
    scenery(400);
    EXPECT_EQ(pose_bounds(model, 0.0, 2).upper, Vec3f(400, 2, 3));
    EXPECT_EQ(framed_bounds(Bounds(), model.scenery.positions.floats()).upper, Vec3f(400, 1, 1));
}

TEST(SequenceBounds, OfNothingAreEmpty) {
    Asset model = moving_points(3);
    model.moving().topology.num_vertices = 0;
    for (LowRank* matrix : {&model.moving().positions, &model.moving().transfer->matrix}) {
        matrix->num_points = 0;
        matrix->mean = {};
        matrix->components.clear();
    }
    EXPECT_TRUE(sequence_bounds(model).empty());
}

}  // namespace
}  // namespace paim
