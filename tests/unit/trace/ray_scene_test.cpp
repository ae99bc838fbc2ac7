// Rays against triangles: hits on both sides, distances, watertight edges, nothing at all.
#include "paim/trace/ray_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "poses/shapes.h"

namespace paim {
namespace {

const Topology kTriangle{3, {{0, 1, 2}}};
const std::vector<Vec3f> kCorners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};

TEST(RayScene, HitsBothSidesAtTheRightPlace) {
    const RayScene scene(kTriangle, kCorners);
    for (const float side : {1.0f, -1.0f}) {
        const auto hit = scene.intersect_first({0.25f, 0.5f, 2.0f * side}, {0, 0, -side});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, 2.0f, 1e-6f);
        EXPECT_EQ(hit->triangle, 0u);
        EXPECT_NEAR(hit->u, 0.25f, 1e-6f);
        EXPECT_NEAR(hit->v, 0.5f, 1e-6f);
    }
    EXPECT_FALSE(scene.intersect_first({0.75f, 0.75f, 1}, {0, 0, -1}));
    EXPECT_FALSE(scene.intersect_first({0.25f, 0.25f, 1}, {0, 0, 1}));
}

TEST(RayScene, CountsBlockedDirections) {
    const RayScene scene(kTriangle, kCorners);
    const float x[] = {0, 0, 1}, y[] = {0, 0, 0}, z[] = {-1, 1, 0};
    float occluded[3];
    EXPECT_EQ(scene.occluded({0.2f, 0.2f, 1}, x, y, z, 3, occluded), 1u);
    EXPECT_EQ(occluded[0], 1.0f);
    EXPECT_EQ(occluded[1], 0.0f);
    EXPECT_EQ(occluded[2], 0.0f);
}

TEST(RayScene, PacketsAnswerAsSingleRays) {
    // Any count, so that packets that are not full are among them.
    const auto sequence = poses::make_bowl_sequence(600);
    const auto positions = sequence->positions(0, 1);
    const RayScene scene(sequence->topology(), positions);
    RandomStream random(4);
    uint32_t total = 0;
    for (uint32_t count = 0; count < 100; ++count) {
        std::vector<float> x(count), y(count), z(count), occluded(count + 1, -1.0f);
        const auto coordinate = [&] { return static_cast<float>(random.uniform() - 0.5); };
        for (size_t j = 0; j < count; ++j) {
            const Vec3f direction = Vec3f(coordinate(), coordinate(), coordinate()).normalized();
            x[j] = direction.x();
            y[j] = direction.y();
            z[j] = direction.z();
        }
        const Vec3f origin(coordinate(), coordinate(), coordinate());
        uint32_t expected = 0;
        const uint32_t num_occluded =
            scene.occluded(origin, x.data(), y.data(), z.data(), count, occluded.data());
        for (size_t j = 0; j < count; ++j) {
            const bool hit = scene.intersect_first(origin, {x[j], y[j], z[j]}).has_value();
            ASSERT_EQ(occluded[j], hit ? 1.0f : 0.0f) << count << ' ' << j;
            expected += hit ? 1 : 0;
        }
        std::vector<Hit> hits(count + 1, Hit{-1.0f, 7, 0.0f, 0.0f});
        scene.intersect(origin, x.data(), y.data(), z.data(), count, hits.data());
        for (size_t j = 0; j < count; ++j) {
            const auto hit = scene.intersect_first(origin, {x[j], y[j], z[j]});
            ASSERT_EQ(hits[j].triangle, hit ? hit->triangle : kNoTriangle);
            if (!hit) continue;
            // Packets and single rays multiply in another order.
            EXPECT_NEAR(hits[j].distance, hit->distance, 1e-5f);
            EXPECT_NEAR(hits[j].u, hit->u, 1e-4f);
            EXPECT_NEAR(hits[j].v, hit->v, 1e-4f);
        }
        EXPECT_EQ(hits[count].distance, -1.0f);
        EXPECT_EQ(num_occluded, expected);
        EXPECT_EQ(occluded[count], -1.0f);
        total += expected;
    }
    EXPECT_GT(total, 500u);   // of 4950: the bowl is in the way of some,
    EXPECT_LT(total, 4500u);  // not of all
}

TEST(RayScene, PassesThroughTrianglesThatAreIgnored) {
    // Three triangles over each other, the middle one twice.
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        Topology topology{12, {}};
        std::vector<Vec3f> positions;
        for (const float z : {0.0f, 1.0f, 1.0f, 2.0f}) {
            const auto n = static_cast<uint32_t>(positions.size());
            topology.triangles.push_back({n, n + 1, n + 2});
            for (const Vec3f& x : kCorners) positions.push_back(scale * (x + Vec3f(0, 0, z)));
        }
        const RayScene scene(topology, positions);
        const auto first = [&](const std::vector<uint32_t>& ignored) {
            const auto hit =
                scene.intersect_first(scale * Vec3f(0.2f, 0.2f, 3), {0, 0, -1}, ignored);
            return hit ? hit->triangle : kNoTriangle;
        };
        EXPECT_EQ(first({}), 3u);
        EXPECT_EQ(first({0}), 3u);
        EXPECT_TRUE(first({3}) == 1 || first({3}) == 2);
        EXPECT_EQ(first({1, 2, 3}), 0u);
        EXPECT_EQ(first({0, 1, 2, 3}), kNoTriangle);
        // From a corner of ignored triangles, in their plane and out of it.
        for (const Vec3f& d : {Vec3f(1, 0, 0), Vec3f(1, 1, 0), Vec3f(0.3f, 0.2f, -0.9f)}) {
            const auto hit = scene.intersect_first(scale * Vec3f(0, 0, 1), d.normalized(),
                                                   std::vector<uint32_t>{1, 2});
            EXPECT_EQ(hit.has_value(), d.z() < 0.0f) << d.transpose();
            EXPECT_EQ(hit ? hit->triangle : 0u, 0u);
        }
    }
}

TEST(RayScene, HitsTheSameAtAnyScale) {
    // Powers of two, so that the scaled mesh is exactly the same.
    for (const int exponent : {-120, -60, 0, 60, 120}) {
        const float scale = std::ldexp(1.0f, exponent);
        std::vector<Vec3f> corners = kCorners;
        for (Vec3f& x : corners) x *= scale;
        const RayScene scene(kTriangle, corners);
        const auto hit = scene.intersect_first(scale * Vec3f(0.25f, 0.5f, 2.0f), {0, 0, -1});
        ASSERT_TRUE(hit) << exponent;
        EXPECT_NEAR(hit->distance / scale, 2.0f, 1e-6f);
        const float zero[] = {0}, down[] = {-1};
        float occluded[1];
        EXPECT_EQ(scene.occluded(scale * Vec3f(0.25f, 0.5f, 2.0f), zero, zero, down, 1, occluded),
                  1u);
    }
}

// A vertex that is far beyond the others takes its own triangle along, and nothing else.
TEST(RayScene, SeesPastAnOutlier) {
    const Topology two{6, {{0, 1, 2}, {3, 4, 5}}};
    for (const float far : {1e6f, 1e20f, 1e38f}) {
        for (const float scale : {1e-20f, 1.0f, 1e20f}) {
            if (far * scale > 3e38f) continue;
            std::vector<Vec3f> corners = kCorners;
            corners.insert(corners.end(), {{0, 0, 5}, {1, 0, 5}, {far, far, far}});
            for (Vec3f& x : corners) x *= scale;
            const RayScene scene(two, corners);
            const auto hit = scene.intersect_first(scale * Vec3f(0.25f, 0.5f, 2.0f), {0, 0, -1});
            ASSERT_TRUE(hit) << far << ' ' << scale;
            EXPECT_NEAR(hit->distance / scale, 2.0f, 1e-6f);
        }
    }
}

TEST(RayScene, CountsTheSecondMeshAfterTheFirst) {
    // The second one lies nearer to the ray's start and is smaller.
    std::vector<Vec3f> nearer = kCorners;
    for (Vec3f& x : nearer) x = 0.5f * x + Vec3f(0, 0, 1);
    const RayScene scene(kTriangle, kCorners, kTriangle, nearer);
    const auto both = scene.intersect_first({0.1f, 0.1f, 2}, {0, 0, -1});
    ASSERT_TRUE(both);
    EXPECT_EQ(both->triangle, kTriangle.triangles.size());
    const float zeros[] = {0, 0}, down[] = {-1, 1};
    Hit hits[2];
    scene.intersect({0.1f, 0.1f, 2}, zeros, zeros, down, 2, hits);
    EXPECT_EQ(hits[0].triangle, kTriangle.triangles.size());
    EXPECT_EQ(hits[1].triangle, kNoTriangle);
    const auto first = scene.intersect_first({0.1f, 0.1f, 0.5f}, {0, 0, -1});
    ASSERT_TRUE(first);
    EXPECT_EQ(first->triangle, 0u);
    const auto alone =
        RayScene({}, {}, kTriangle, nearer).intersect_first({0.1f, 0.1f, 2}, {0, 0, -1});
    ASSERT_TRUE(alone);
    EXPECT_EQ(alone->triangle, 0u);
}

TEST(RayScene, TrianglesWithoutAreaAreNeverHit) {
    // Needles from a corner that lies anywhere, their other corners twice and three times as far
    // off: these products are exact, and so all three are on a line. Rays aimed at points of it
    // would hit some of them, for rounding leaves their products with an area.
    RandomStream random(6);
    for (int j = 0; j < 2000; ++j) {
        const auto coordinate = [&] { return static_cast<float>(random.uniform() - 0.5); };
        const Vec3f x = Vec3f(coordinate(), coordinate(), coordinate());
        const std::vector<Vec3f> corners{x, 8.0f * x, 4.0f * x};
        const RayScene scene(kTriangle, corners);
        const Vec3f from(coordinate(), coordinate(), coordinate());
        const Vec3f at = (2.0f + 10.0f * std::abs(coordinate())) * x;
        const Vec3f d = (at - from).normalized();
        float occluded = 0.0f;
        EXPECT_EQ(scene.occluded(from, &d.x(), &d.y(), &d.z(), 1, &occluded), 0u) << j;
        EXPECT_FALSE(scene.intersect_first(from, d)) << j;
    }
}

TEST(RayScene, HoldsNothingWithoutTriangles) {
    const Topology isolated{1, {}};
    const RayScene scene(isolated, std::vector<Vec3f>{{0, 0, 0}});
    EXPECT_FALSE(scene.intersect_first({0, 0, 1}, {0, 0, -1}));
}

TEST(RayScene, LetsNoRayOutOfAClosedMesh) {
    const auto sequence = poses::make_sphere_sequence(600);
    const auto positions = sequence->positions(0, 1);
    const RayScene scene(sequence->topology(), positions);
    RandomStream random(3);
    for (int j = 0; j < 20000; ++j) {
        // Towards vertices and points of edges too, where cracks would be.
        const auto& t =
            sequence->topology()
                .triangles[static_cast<size_t>(j) % sequence->topology().triangles.size()];
        const auto along = static_cast<float>(random.uniform());
        const Vec3f target =
            j % 2 == 0 ? positions[t[0]]
                       : Vec3f((1.0f - along) * positions[t[0]] + along * positions[t[1]]);
        ASSERT_TRUE(scene.intersect_first(Vec3f::Zero(), target.normalized())) << j;
    }
}

}  // namespace
}  // namespace paim
