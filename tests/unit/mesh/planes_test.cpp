// Points to planes and back.
#include "paim/mesh/planes.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(Planes, HoldOneAxisAfterTheOther) {
    const std::vector<Vec3f> points{{1, 2, 3}, {4, 5, 6}};
    EXPECT_EQ(to_planes(points), (std::vector<float>{1, 4, 2, 5, 3, 6}));
    EXPECT_EQ(from_planes(to_planes(points)), points);
    EXPECT_TRUE(from_planes({}).empty());
}

TEST(PlanesDeathTest, RefuseHalfAPoint) {
    EXPECT_DEATH(from_planes(std::vector<float>(4)), "check failed");
}

}  // namespace
}  // namespace paim
