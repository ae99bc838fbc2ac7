// Rays that meet triangles at known places.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/mesh/planes.h"
#include "player/inspect/pick.h"

namespace paim::player {
namespace {

// A mesh that keeps what PickSurface refers to.
struct Mesh {
    Topology topology;
    std::vector<float> planes;

    Mesh(const std::vector<Vec3f>& corners, std::vector<Triangle> triangles)
        : topology{static_cast<uint32_t>(corners.size()), std::move(triangles)},
          planes(to_planes(corners)) {}
    PickSurface surface() const { return {&topology, planes}; }
};

// The unit square at a height z, cut along the diagonal from (1, 0) to (0, 1).
Mesh square_at(float z) {
    return {{{0, 0, z}, {1, 0, z}, {0, 1, z}, {1, 1, z}}, {{0, 1, 2}, {1, 3, 2}}};
}

Ray down_at(float x, float y) {
    return {{x, y, 5}, {0, 0, -2}};
}

TEST(Pick, FindsTriangleCornersAndDistance) {
    const Mesh mesh = square_at(1.0f);
    const std::vector<PickSurface> parts{mesh.surface()};
    const auto low = pick(down_at(0.25f, 0.125f), parts);
    ASSERT_TRUE(low);
    EXPECT_EQ(low->triangle, 0u);
    EXPECT_EQ(low->vertex, 0u);
    EXPECT_EQ(low->barycentric, Vec3f(0.625f, 0.25f, 0.125f));
    EXPECT_EQ(low->distance, 4.0);
    const auto high = pick(down_at(0.5f, 0.875f), parts);
    ASSERT_TRUE(high);
    EXPECT_EQ(high->triangle, 1u);
    EXPECT_EQ(high->barycentric, Vec3f(0.125f, 0.375f, 0.5f));  // of (1, 0), (1, 1), (0, 1)
    // (0, 1) and (1, 1) are equally far: the first corner of the triangle of these is (1, 1).
    EXPECT_EQ(high->vertex, 3u);
}

TEST(Pick, MissesWhatIsOutsideBehindOrEmpty) {
    const Mesh mesh = square_at(1.0f);
    const Mesh empty({}, {});
    const std::vector<PickSurface> parts{empty.surface(), mesh.surface()};
    EXPECT_FALSE(pick(down_at(1.25f, 0.5f), parts));
    EXPECT_FALSE(pick(down_at(-0.001f, 0.5f), parts));
    EXPECT_FALSE(pick({{0.25f, 0.25f, 0.5f}, {0, 0, -1}}, parts));
    EXPECT_FALSE(pick({{0, 0, 1}, {1, 0, 0}}, parts));  // in the plane
    EXPECT_FALSE(pick(down_at(0.5f, 0.5f), {}));
    const Mesh half({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    EXPECT_TRUE(pick(down_at(0.5f, 0.5f), std::vector{half.surface()}));
    EXPECT_FALSE(pick(down_at(0.5f, 0.501f), std::vector{half.surface()}));
    const auto hit = pick({{0.25f, 0.25f, 0.5f}, {0, 0, 1}}, parts);  // from the back
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->part, 1u);
    EXPECT_EQ(hit->distance, 0.5);
}

TEST(Pick, TakesTheNearestAndOfEquallyNearOnesTheFirst) {
    const Mesh low = square_at(0.0f), high = square_at(2.0f), same = square_at(2.0f);
    const std::vector<PickSurface> parts{low.surface(), high.surface(), same.surface()};
    EXPECT_EQ(pick(down_at(0.25f, 0.25f), parts)->part, 1u);
    // On the edge that both triangles share.
    EXPECT_EQ(pick(down_at(0.5f, 0.5f), parts)->triangle, 0u);
    const Mesh doubled({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{2, 1, 0}, {0, 1, 2}, {0, 1, 2}});
    EXPECT_EQ(pick(down_at(0.25f, 0.25f), std::vector{doubled.surface()})->triangle, 0u);
}

TEST(Pick, PassesTrianglesWithoutAreaAndNumbersThatAreNone) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    const Mesh mesh(
        {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {0.5f, 0, 1}, {0, 0, kNaN}, {0, kInfinity, 2}},
        {{0, 3, 1}, {0, 0, 2}, {4, 1, 2}, {0, 1, 5}, {0, 1, 2}});
    const auto hit = pick(down_at(0.25f, 0.0f), std::vector{mesh.surface()});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->triangle, 4u);
}

// Enough triangles for several pieces of work; all lie where the ray passes, in random order.
TEST(Pick, IsTheSameOnAnyNumberOfThreads) {
    RandomStream random(1);
    std::vector<Vec3f> corners;
    std::vector<Triangle> triangles;
    for (uint32_t t = 0; t < 100000; ++t) {
        const auto z = static_cast<float>(std::floor(1000.0 * random.uniform()));
        for (const auto& [x, y] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {0.0f, 1.0f}}) {
            corners.emplace_back(x, y, z);
        }
        triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
    }
    uint32_t expected = 0;
    for (uint32_t t = 0; t < triangles.size(); ++t) {
        if (corners[3 * t].z() > corners[3 * expected].z()) expected = t;
    }
    const Mesh mesh(corners, triangles);
    for (const int num_threads : {1, 0}) {
        const ThreadLimit limit(num_threads);
        const auto hit = pick({{0.2f, 0.2f, 2000}, {0, 0, -1}}, std::vector{mesh.surface()});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->triangle, expected);
    }
}

TEST(RayThroughPixel, IsThatOfTheCamera) {
    Camera camera;
    camera.eye = {1, 2, 8};
    camera.target = {1, 2, 0};
    const Ray middle = ray_through_pixel(camera, 0.5f, 0.5f, 1.5f);
    EXPECT_EQ(middle.origin, camera.eye);
    EXPECT_LT((middle.direction - Vec3f(0, 0, -1)).norm(), 1e-6f);
    const Ray corner = ray_through_pixel(camera, 0.0f, 0.0f, 1.5f);
    EXPECT_EQ(corner.direction, camera.ray_direction(0.0f, 0.0f, 1.5f));
    EXPECT_LT(corner.direction.x(), 0.0f);
    EXPECT_GT(corner.direction.y(), 0.0f);
}

}  // namespace
}  // namespace paim::player
