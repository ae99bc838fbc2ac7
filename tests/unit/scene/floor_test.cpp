// A ground under poses: where it lies, how fine it is, what it does to names, checksums and
// colours.
#include "compressor/scene/floor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/ray_offset.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/base/error.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/pose_set.h"
#include "poses/octopus.h"
#include "poses/shapes.h"

namespace paim {
namespace {

Bounds box(const Vec3f& lower, const Vec3f& upper) {
    Bounds bounds;
    bounds.extend(lower);
    bounds.extend(upper);
    return bounds;
}

// Of a body that stays in its place.
BodyBounds in_place(const Bounds& bounds) {
    return {bounds, double{(bounds.upper - bounds.lower).maxCoeff()}};
}

Bounds bounds_over(const PoseSource& source) {
    Bounds bounds;
    for (uint32_t p = 0; p < source.num_poses(); ++p) bounds.extend(source.load_pose(p).positions);
    return bounds;
}

TEST(Floor, LiesJustUnderTheLowestPointAndFacesUp) {
    const Floor floor(in_place(box({-1, -2, -3}, {3, 1, 1})), 4000);  // 4 across
    EXPECT_LT(floor.height, -2.0f);
    EXPECT_GT(floor.height, -2.01f);
    Bounds bounds;
    bounds.extend(floor.positions);
    // 0.3 of the largest extent beyond the poses; rounded once to float.
    EXPECT_TRUE(bounds.lower.isApprox(Vec3f(-2.2f, floor.height, -4.2f)));
    EXPECT_TRUE(bounds.upper.isApprox(Vec3f(4.2f, floor.height, 2.2f)));
    for (const Vec3f& n : vertex_normals(floor.topology, floor.positions)) {
        EXPECT_EQ(n, Vec3f::UnitY());
    }
    // Its triangles tile the rectangle: their areas add up to it, none is empty.
    double area = 0.0;
    for (const Triangle& t : floor.topology.triangles) {
        const Vec3d a = floor.positions[t[0]].cast<double>();
        const double part = 0.5 * (floor.positions[t[1]].cast<double>() - a)
                                      .cross(floor.positions[t[2]].cast<double>() - a)
                                      .y();
        EXPECT_GT(part, 0.0);
        area += part;
    }
    EXPECT_NEAR(area, 6.4 * 6.4, 1e-4);  // floats of about 5 are rounded by 2e-7 of them
}

TEST(Floor, KeepsToItsVerticesAndIsFineUnderThePoses) {
    for (const uint32_t most : {kMinFloorVertices, 100u, 4000u, 50'000u}) {
        // A square, a long path, a thin post and a flat sheet that stands on edge.
        for (const Bounds& bounds : {box({0, 0, 0}, {1, 1, 1}), box({0, 0, 0}, {20, 1, 1}),
                                     box({5, 0, 5}, {5, 9, 5}), box({0, 0, 0}, {1, 1, 0})}) {
            const Floor floor(in_place(bounds), most);
            EXPECT_LE(floor.positions.size(), most);
            if (most >= 4000) {
                EXPECT_GE(floor.positions.size(), most * 9 / 10);
            }
            EXPECT_EQ(floor.positions.size(), floor.topology.num_vertices);
            // The shortest cell lies under the poses, the longest at the edge.
            const float extent = (bounds.upper - bounds.lower).maxCoeff();
            const float middle = 0.5f * (bounds.lower.x() + bounds.upper.x());
            float nearest = extent, farthest = 0.0f;
            std::vector<float> x;
            for (const Vec3f& position : floor.positions) x.push_back(position.x());
            std::sort(x.begin(), x.end());
            x.erase(std::unique(x.begin(), x.end()), x.end());
            for (size_t i = 1; i < x.size(); ++i) {
                if (x[i - 1] <= middle && middle <= x[i]) nearest = x[i] - x[i - 1];
                farthest = std::max(farthest, x[i] - x[i - 1]);
            }
            EXPECT_LE(nearest, farthest);
            if (most >= 4000) {
                EXPECT_LT(nearest, 0.03f * extent);
                EXPECT_LT(nearest, 0.5f * farthest);
            }
        }
    }
}

TEST(Floor, StaysBelowPosesThatAreFarAway) {
    // Where a step of a float is 1/16.
    const Floor floor(in_place(box({1e6f, 1e6f, 1e6f}, {1e6f + 2, 1e6f + 2, 1e6f + 2})), 100);
    EXPECT_LT(floor.height, 1e6f);
}

TEST(Floor, RefusesWhatHasNoSizeOrTooMuch) {
    const auto complaint = [](const Bounds& bounds) -> std::string {
        try {
            const Floor floor(in_place(bounds), 100);
            return "nothing";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            return error.what();
        }
    };
    EXPECT_NE(complaint(box({1, 2, 3}, {1, 2, 3})).find("one point"), std::string::npos);
    EXPECT_NE(complaint(box({-3e38f, -3e38f, 0}, {3e38f, 3e38f, 1})).find("too large"),
              std::string::npos);
}

TEST(PosesOnFloor, AddsTheSameGroundToEveryPose) {
    const PoseSet octopus = poses::make_octopus(1000, 3);
    const BodyBounds of_octopus = bounds_of(octopus);
    const Bounds& bounds = of_octopus.all;
    const Bounds expected = bounds_over(octopus);
    EXPECT_EQ(bounds.lower, expected.lower);
    EXPECT_EQ(bounds.upper, expected.upper);

    FloorOptions options;
    options.num_vertices = 400;
    options.albedo = Vec3f(0.1f, 0.2f, 0.3f);
    const PosesOnFloor on_floor(octopus, of_octopus, options);
    const uint32_t num_own = octopus.topology().num_vertices;
    const uint32_t num_all = on_floor.topology().num_vertices;
    ASSERT_LT(num_own, num_all);
    EXPECT_EQ(on_floor.num_poses(), 3u);
    for (uint32_t p = 0; p < 3; ++p) {
        const Pose own = octopus.load_pose(p), pose = on_floor.load_pose(p);
        ASSERT_EQ(pose.positions.size(), num_all);
        ASSERT_EQ(pose.normals.size(), num_all);
        EXPECT_TRUE(std::equal(own.positions.begin(), own.positions.end(), pose.positions.begin()));
        EXPECT_TRUE(std::equal(own.normals.begin(), own.normals.end(), pose.normals.begin()));
        for (uint32_t v = num_own; v < num_all; ++v) {
            EXPECT_LT(pose.positions[v].y(), bounds.lower.y());
            EXPECT_EQ(pose.normals[v], Vec3f::UnitY());
        }
        EXPECT_EQ(on_floor.pose_name(p), octopus.pose_name(p));
        EXPECT_NE(on_floor.pose_checksum(p), octopus.pose_checksum(p));
    }
    const auto& triangles = on_floor.topology().triangles;
    const auto& own = octopus.topology().triangles;
    EXPECT_TRUE(std::equal(own.begin(), own.end(), triangles.begin()));
    for (size_t f = own.size(); f < triangles.size(); ++f) {
        for (const uint32_t v : triangles[f]) {
            EXPECT_GE(v, num_own);
            EXPECT_LT(v, num_all);
        }
    }
    EXPECT_EQ(on_floor.albedo().at(0), octopus.albedo().at(0));
    EXPECT_EQ(on_floor.albedo().at(num_own), options.albedo);

    // Other floors are other poses.
    options.num_vertices = 300;
    EXPECT_NE(PosesOnFloor(octopus, of_octopus, options).pose_checksum(0),
              on_floor.pose_checksum(0));
    EXPECT_NE(PosesOnFloor(octopus, of_octopus, options).description(), on_floor.description());
}

TEST(PosesOnFloor, GoesByTheVerticesOfTriangles) {
    const auto pose = [](float y) {
        return std::vector<Vec3f>{{0, -100, 0}, {0, y, 0},  {1, 0, 0},
                                  {0, 1, 0},    {90, 0, 0}, {0, 0, 90}};
    };
    const PoseSet stray({6, {{1, 2, 3}}}, {pose(0.0f), pose(-0.5f)});
    const Bounds bounds = bounds_of(stray).all;
    EXPECT_EQ(bounds.lower, Vec3f(0, -0.5f, 0));
    EXPECT_EQ(bounds.upper, Vec3f(1, 1, 0));
}

// A sequence that is moved by this much from each pose to the next.
PoseSet travelling(const PoseSet& still, const Vec3f& step) {
    std::vector<std::vector<Vec3f>> poses;
    for (uint32_t p = 0; p < still.num_poses(); ++p) {
        poses.push_back(still.load_pose(p).positions);
        for (Vec3f& x : poses.back()) x += static_cast<float>(p) * step;
    }
    return PoseSet(still.topology(), poses);
}

// From the lowest point of all poses down to the floor.
double gap_under(const PoseSet& poses) {
    const PosesOnFloor on_floor(poses, bounds_of(poses), {400, Vec3f::Constant(0.8f)});
    const Bounds bounds = bounds_over(poses);
    return double{bounds.lower.y()} - double{on_floor.load_pose(0).positions.back().y()};
}

TEST(PosesOnFloor, IsAsCloseToABodyThatTravels) {
    const PoseSet octopus = poses::make_octopus(1000, 9);
    const Bounds still = bounds_over(octopus);
    const double size = double{(still.upper - still.lower).maxCoeff()};
    // In its place, 5e-4 of all poses, rounded with the floor's height.
    const double rounding = 1e-7 * double{still.lower.cwiseAbs().maxCoeff()};
    EXPECT_NEAR(gap_under(octopus), 5e-4 * size, rounding);
    for (const float lengths : {1.0f, 20.0f, 1000.0f}) {
        const float step = lengths * static_cast<float>(size) / 8.0f;
        PoseSet walk = travelling(octopus, Vec3f(step, 0, -step));
        const double far = double{lengths} * size;
        // Twice as much at most, but for what floats need so far away: 16 roundings, with one for
        // the height's own.
        EXPECT_LE(gap_under(walk), std::max(1e-3 * size, 17.0 * 0x1p-23 * (far + 2.0 * size)));
        EXPECT_GE(gap_under(walk), 4e-4 * size);
    }
}

TEST(PosesOnFloor, LeavesOutABrokenPoseOfABodyThatTravels) {
    const PoseSet octopus = poses::make_octopus(1000, 9);
    const PoseSet walk = travelling(octopus, Vec3f(100, 0, 0));
    std::vector<std::vector<Vec3f>> poses;
    for (uint32_t p = 0; p < 9; ++p) poses.push_back(walk.load_pose(p).positions);
    // Without a known path, it is hidden by the walk.
    poses[4][7].x() += 300.0f;
    // The median of nine extents becomes the next one (observed: 0.3 % more).
    EXPECT_LT(gap_under(PoseSet(walk.topology(), poses)), 1.1 * gap_under(walk));
}

// Rays that start at the floor start below the body, and rays that start at the body above the
// floor.
TEST(PosesOnFloor, LeavesRoomForRaysFarAway) {
    const PoseSet box = poses::make_pose_set(*poses::make_box_sequence(600), 2);
    for (const float step : {0.0f, 1e3f, 1e5f}) {
        const PoseSet walk = travelling(box, Vec3f(0, 0, step));
        const PosesOnFloor on_floor(walk, bounds_of(walk), {400, Vec3f::Constant(0.8f)});
        const Pose pose = on_floor.load_pose(1);
        const std::vector<float> offsets =
            ray_offsets(on_floor.topology(), pose.positions, {0.0, RayOffsetRule().of_coordinate});
        const auto floor = static_cast<ptrdiff_t>(walk.topology().num_vertices);
        const double most = double{*std::max_element(offsets.begin(), offsets.begin() + floor)} +
                            double{*std::max_element(offsets.begin() + floor, offsets.end())};
        EXPECT_GT(gap_under(walk), most) << step;
    }
}

TEST(PosesOnFloor, OneColourStaysOne) {
    const PoseSet sphere = poses::make_pose_set(*poses::make_sphere_sequence(50), 1);
    const PosesOnFloor on_floor(sphere, bounds_of(sphere), {100, sphere.albedo().at(0)});
    EXPECT_EQ(on_floor.albedo().values.size(), 1u);
}

TEST(PosesOnFloor, IsDarkWhereABoxStandsAndOpenFarAway) {
    const PoseSet box_set = poses::make_pose_set(*poses::make_box_sequence(600), 1);
    FloorOptions options;
    options.num_vertices = 1000;
    const PosesOnFloor on_floor(box_set, bounds_of(box_set), options);
    const Pose pose = on_floor.load_pose(0);
    const BakedPose baked = TransferBaker({1, 512, 1}).bake(on_floor.topology(), pose, 0);
    const double y00 = std::sqrt(0.25 / kPi);
    for (size_t v = box_set.topology().num_vertices; v < pose.positions.size(); ++v) {
        const Vec3f& x = pose.positions[v];
        const double open = static_cast<double>(baked.transfer[v]) / y00;
        const double outside = std::max(std::abs(x.x()), std::abs(x.z())) - 1.0f;
        // Under the box nothing is seen but its bottom, at a gap of 1e-3; farther in than ten gaps
        // the strip of sky that is left subtends less than (gap / distance)² of the cosine-weighted
        // sky.
        if (outside < -0.01) {
            EXPECT_LT(open, 0.01);
        }
        // At its side it hides nearly half the sky; at the floor's edge the wall of 2 × 2 from a
        // distance of 0.6 hides at most what a wall of endless width would, half of 1 − cos of its
        // elevation: (1 − 0.6/√4.36) / 2 = 0.36.
        if (outside > 0.599) {
            EXPECT_GT(open, 1.0 - 0.36 - 0.01);
        }
        EXPECT_LE(open, 1.0 + 1e-6);
    }
}

}  // namespace
}  // namespace paim
