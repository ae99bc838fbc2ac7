// Which positions are outliers, and which are motion.
#include "paim/mesh/outliers.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>

namespace paim {
namespace {

using PositionOf = std::function<Vec3f(uint32_t v, uint32_t p)>;

// Two units tall; every vertex swings by 0.3.
Vec3f swing(uint32_t v, uint32_t p) {
    const float height = 0.02f * static_cast<float>(v % 101);
    return {0.3f * height * std::sin(0.8f * static_cast<float>(p)), height,
            0.2f * std::cos(static_cast<float>(v))};
}

PositionOutliers outliers_of(uint32_t num_vertices, uint32_t num_poses,
                             const PositionOf& position) {
    std::vector<uint32_t> counted(num_vertices);
    std::iota(counted.begin(), counted.end(), 0u);
    return find_outliers(num_vertices, num_poses, counted,
                         [&](uint32_t p, uint64_t first, uint64_t count, float* rows) {
                             for (uint64_t r = first; r < first + count; ++r) {
                                 const auto v = static_cast<uint32_t>(r % num_vertices);
                                 *rows++ = position(v, p)[static_cast<int>(r / num_vertices)];
                             }
                         });
}

std::vector<std::array<uint32_t, 2>> places_of(const PositionOutliers& outliers) {
    std::vector<std::array<uint32_t, 2>> places;
    for (const PositionOutlier& one : outliers.all()) places.push_back({one.pose, one.vertex});
    return places;
}

using OutlierPlaces = std::vector<std::array<uint32_t, 2>>;

// swing() with the vertices at these places (pose, vertex) elsewhere.
PositionOf broken(const OutlierPlaces& places, const Vec3f& bad) {
    return [=](uint32_t v, uint32_t p) {
        const bool is_bad =
            std::find(places.begin(), places.end(), std::array{p, v}) != places.end();
        return is_bad ? bad : swing(v, p);
    };
}

TEST(Outliers, AreFoundWithWhereTheyUsuallyAre) {
    const Vec3f bad(5000, 4000, 0);
    const PositionOutliers found = outliers_of(101, 8, broken({{4, 17}}, bad));
    ASSERT_EQ(places_of(found), (OutlierPlaces{{4, 17}}));
    const PositionOutlier& one = found.all()[0];
    EXPECT_EQ(one.position, bad);
    EXPECT_LT((one.usual - 0.5f * (swing(17, 3) + swing(17, 5))).norm(), 1e-6f);
    EXPECT_NEAR(one.distance(), (bad - one.usual).norm(), 1e-3);
}

TEST(Outliers, AreFoundWhereverTheyAre) {
    const std::vector<OutlierPlaces> kinds = {
        {{0, 3}},                                   // the first pose
        {{7, 3}},                                   // the last one
        {{3, 5}, {4, 5}},                           // two in a row
        {{1, 5}, {6, 5}},                           // two apart
        {{2, 0}, {2, 50}, {2, 100}},                // several vertices of a pose
        {{0, 9}, {3, 1}, {3, 100}, {5, 9}, {7, 4}}  // here and there
    };
    for (const OutlierPlaces& places : kinds) {
        for (const float far : {40.0f, 5000.0f, 1e30f, 3.3e38f}) {
            const Vec3f bad(far, -far, 0.0f);
            EXPECT_EQ(places_of(outliers_of(101, 8, broken(places, bad))), places) << far;
        }
    }
    // Another vertex in every pose, so that every pose is as large as its outlier.
    OutlierPlaces every;
    for (uint32_t p = 0; p < 8; ++p) every.push_back({p, 5 * p});
    EXPECT_EQ(places_of(outliers_of(101, 8, broken(every, {-7000, 2, 1}))), every);
}

TEST(Outliers, CanBeAWholePose) {
    for (const uint32_t bad_pose : {0u, 4u}) {
        const PositionOutliers found = outliers_of(101, 12, [=](uint32_t v, uint32_t p) {
            return Vec3f(swing(v, p) + (p == bad_pose ? Vec3f(900, 0, 0) : Vec3f(0, 0, 0)));
        });
        EXPECT_EQ(found.all().size(), 101u);
        EXPECT_EQ(found.poses(), std::vector<uint32_t>{bad_pose});
    }
}

TEST(Outliers, AreNotMotion) {
    const auto none = [](uint32_t num_poses, const PositionOf& position, const char* what) {
        EXPECT_TRUE(outliers_of(101, num_poses, position).empty()) << what;
    };
    const auto time = [](uint32_t p) { return static_cast<float>(p); };
    none(40, swing, "swings");
    none(
        40, [&](uint32_t v, uint32_t p) { return Vec3f(swing(v, p) + Vec3f(2 * time(p), 0, 0)); },
        "walks 80 units");
    none(
        40,
        [&](uint32_t v, uint32_t p) {
            const float after = std::max(0.0f, time(p) - 32);
            return Vec3f(swing(v, p) * (1.0f + 0.9f * after * after));
        },
        "stands, and flies apart at last, to 50 times its size");
    none(
        40,
        [&](uint32_t v, uint32_t p) {
            const float away = v < 3 ? 1.5f * std::max(0.0f, time(p) - 32) : 0.0f;
            return Vec3f(swing(v, p) + Vec3f(away, 0, 0));
        },
        "a small piece flies away at last");
    none(
        40,
        [&](uint32_t v, uint32_t p) {
            return Vec3f(swing(v, p) + (p >= 31 ? Vec3f(70, 0, 0) : Vec3f(0, 0, 0)));
        },
        "a cut to another place");
    none(
        40,
        [&](uint32_t v, uint32_t p) {
            return Vec3f(100.0f * std::cos(time(p)) * (v == 3), swing(v, p).y(), 0);
        },
        "one vertex is fast in all poses");
    none(
        40, [&](uint32_t v, uint32_t p) { return p < 38 ? Vec3f(0, 0, 0) : swing(v, p); },
        "a point becomes a body");
    none(
        40, [](uint32_t, uint32_t) { return Vec3f(1, 2, 3); }, "a point");
    // Nobody knows which of two poses is the outlier.
    none(2, broken({{1, 17}}, {5000, 4000, 0}), "two poses");
    none(1, swing, "one pose");
}

// More values than are read at once; vertices of no face are not looked at.
TEST(Outliers, AreFoundInLargeMeshesAmongTheVerticesThatCount) {
    constexpr uint32_t kVertices = 130000;
    std::vector<uint32_t> counted;
    for (uint32_t v = 0; v < kVertices; v += 3) counted.push_back(v);
    const PositionOf position =
        broken({{1, 0}, {1, 129998}, {2, 129999}, {0, 60000}}, {0, 1e9f, 0});
    const PositionOutliers found = find_outliers(
        kVertices, 3, counted, [&](uint32_t p, uint64_t first, uint64_t count, float* rows) {
            for (uint64_t r = first; r < first + count; ++r) {
                *rows++ = position(static_cast<uint32_t>(r % kVertices),
                                   p)[static_cast<int>(r / kVertices)];
            }
        });
    EXPECT_EQ(places_of(found), (OutlierPlaces{{0, 60000}, {1, 0}, {2, 129999}}));
}

TEST(Outliers, AreReplacedInAnyRows) {
    const PositionOutliers found =
        outliers_of(101, 8, broken({{3, 5}, {3, 9}, {6, 2}}, {0, 99, 0}));
    ASSERT_EQ(found.all().size(), 3u);
    const PositionOutlier& one = found.of_pose(3)[1];
    EXPECT_EQ(one.vertex, 9u);
    std::vector<float> rows(303, -1.0f);
    found.replace(3, 101, 0, rows);
    EXPECT_EQ(rows[9], one.usual.x());
    EXPECT_EQ(rows[101 + 9], one.usual.y());
    EXPECT_EQ(rows[202 + 9], one.usual.z());
    EXPECT_EQ(std::count(rows.begin(), rows.end(), -1.0f), 303 - 6);
    // Vertex 9's y alone.
    std::vector<float> few(4, -1.0f);
    found.replace(3, 101, 101 + 8, few);
    EXPECT_EQ(few, (std::vector<float>{-1.0f, one.usual.y(), -1.0f, -1.0f}));
    found.replace(4, 101, 0, few);
    EXPECT_EQ(few[0], -1.0f);

    std::vector<uint32_t> old_vertex(101);
    for (uint32_t v = 0; v < 101; ++v) old_vertex[v] = 100 - v;
    const PositionOutliers turned = found.reordered(old_vertex);
    EXPECT_EQ(places_of(turned), (OutlierPlaces{{3, 91}, {3, 95}, {6, 98}}));
    EXPECT_EQ(turned.of_pose(3)[0].usual, one.usual);
}

}  // namespace
}  // namespace paim
