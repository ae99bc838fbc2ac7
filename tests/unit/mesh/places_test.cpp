// Vertices that share places, in one pose and in all of them.
#include "paim/mesh/places.h"

#include <gtest/gtest.h>

#include "paim/base/seed.h"

namespace paim {
namespace {

using Places = std::vector<uint32_t>;

TEST(Places, AreTheFirstVerticesAtEachPosition) {
    const std::vector<Vec3f> positions{{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {-0.0f, 0, -0.0f},
                                       {1, 2, 4}, {1, 2, 3}, {3, 2, 1}};
    EXPECT_EQ(first_at_position(positions), (Places{0, 1, 0, 1, 4, 0, 6}));
    const std::vector<Vec3d> doubles{{1, 0, 0}, {1 + 1e-15, 0, 0}, {1, 0, 0}};
    EXPECT_EQ(first_at_position(doubles), (Places{0, 1, 0}));
    EXPECT_TRUE(first_at_position(std::span(positions).last(2)).empty());
    EXPECT_TRUE(first_at_position(std::span<const Vec3f>()).empty());
}

TEST(Places, OfManyVerticesAreThoseOfASlowSearch) {
    RandomStream random(1);
    std::vector<Vec3f> positions(3000);
    for (Vec3f& x : positions) {
        for (float& value : x) value = static_cast<float>(random.next_u64() % 11);
    }
    const Places places = first_at_position(positions);
    for (uint32_t v = 0; v < positions.size(); ++v) {
        uint32_t first = 0;
        while (positions[first] != positions[v]) ++first;
        EXPECT_EQ(places[v], first);
    }
}

TEST(Places, AreSharedIfTheyAreInEveryPoseWhateverTheirOrder) {
    const std::vector<Vec3f> a{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    const std::vector<Vec3f> b{{5, 0, 0}, {6, 0, 0}, {5, 0, 0}, {6, 0, 0}, {6, 0, 0}, {5, 0, 0}};
    const Places expected{0, 1, 0, 3, 3, 5};
    const Places in_a = first_at_position(a), in_b = first_at_position(b);
    EXPECT_EQ(first_at_position(b, in_a), expected);
    EXPECT_EQ(first_at_position(a, in_b), expected);
    EXPECT_EQ(shared_places(in_a, in_b), expected);
    EXPECT_EQ(shared_places(in_b, in_a), expected);
    EXPECT_TRUE(shared_places(in_a, {}).empty());
}

}  // namespace
}  // namespace paim
