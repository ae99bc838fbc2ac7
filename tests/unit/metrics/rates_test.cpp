// Bits and multiply-adds, against figures worked out by hand.
#include "paim/metrics/rates.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(Rates, BitsPerVertexPerPose) {
    EXPECT_DOUBLE_EQ(bits_per_vertex_per_pose(1000, 100, 10), 8.0);
    EXPECT_EQ(bits_per_vertex_per_pose(1000, 0, 10), 0.0);
    EXPECT_EQ(bits_per_vertex_per_pose(1000, 10, 0), 0.0);
    // Products that do not fit into 64 bits.
    EXPECT_DOUBLE_EQ(
        bits_per_vertex_per_pose(uint64_t{1} << 62, uint64_t{1} << 40, uint64_t{1} << 30), 0x1p-5);
}

// 7 bands: 12 components and the mean of 49 coefficients are 637; light comes after.
TEST(Rates, LightAfterWeights) {
    const TransferLayout grey{TransferKind::diffuse, 7, 1};
    const FrameCost coloured = svd_transfer_cost(grey, 12, true);
    EXPECT_EQ(coloured.decode_per_vertex, 637u);
    EXPECT_EQ(coloured.light_per_vertex, 147u);
    EXPECT_EQ(coloured.per_vertex(), 784u);
    EXPECT_EQ(coloured.cpu_per_frame, 0u);
    EXPECT_EQ(svd_transfer_cost(grey, 12, false).per_vertex(), 637u + 49u);
    const TransferLayout rgb{TransferKind::diffuse, 7, 3};
    for (const bool coloured_light : {false, true}) {
        EXPECT_EQ(svd_transfer_cost(rgb, 12, coloured_light).per_vertex(), 3u * (637u + 49u));
    }
}

TEST(Rates, LightBeforeWeights) {
    const TransferLayout grey{TransferKind::diffuse, 7, 1};
    const FrameCost one = clustered_transfer_cost(grey, 64, 24, 0, false);
    EXPECT_EQ(one.per_vertex(), 25u);
    EXPECT_EQ(one.cpu_per_frame, 64u * 25u * 49u);
    const FrameCost three = clustered_transfer_cost(grey, 64, 24, 0, true);
    EXPECT_EQ(three.per_vertex(), 75u);
    EXPECT_EQ(three.cpu_per_frame, 3u * 64u * 25u * 49u);
    // Bases of ten components in time are rebuilt first, once for all channels of light.
    EXPECT_EQ(clustered_transfer_cost(grey, 64, 24, 10, true).cpu_per_frame,
              (3u + 10u) * 64u * 25u * 49u);
    const TransferLayout rgb{TransferKind::diffuse, 7, 3};
    EXPECT_EQ(clustered_transfer_cost(rgb, 64, 24, 10, true).cpu_per_frame,
              (3u + 30u) * 64u * 25u * 49u);
    EXPECT_EQ(clustered_transfer_cost(rgb, 64, 24, 0, false).per_vertex(), 75u);
    // Does not overflow.
    EXPECT_GT(clustered_transfer_cost(rgb, 1u << 20, 1u << 12, 0, true).cpu_per_frame,
              uint64_t{1} << 38);
}

TEST(Rates, Geometry) {
    EXPECT_EQ(svd_geometry_cost(9).per_vertex(), 30u);
    EXPECT_EQ(svd_geometry_cost(0).per_vertex(), 3u);
}

}  // namespace
}  // namespace paim
