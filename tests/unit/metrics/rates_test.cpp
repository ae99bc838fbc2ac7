// Bits, against figures worked out by hand.
#include "paim/metrics/rates.h"

#include <gtest/gtest.h>

#include <cmath>

namespace paim {
namespace {

TEST(Rates, BitsPerVertexPerPose) {
    EXPECT_DOUBLE_EQ(bits_per_vertex_per_pose(1000, 100, 10), 8.0);
    EXPECT_TRUE(std::isnan(bits_per_vertex_per_pose(1000, 0, 10)));
    EXPECT_TRUE(std::isnan(bits_per_vertex_per_pose(1000, 10, 0)));
    // Products that do not fit into 64 bits.
    EXPECT_DOUBLE_EQ(
        bits_per_vertex_per_pose(uint64_t{1} << 62, uint64_t{1} << 40, uint64_t{1} << 30), 0x1p-5);
}

}  // namespace
}  // namespace paim
