// Multiply-adds of every codec, against figures worked out by hand.
#include "paim/codec/frame_cost.h"

#include <gtest/gtest.h>

#include "paim/codec/cpca/cpca_transfer.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {
namespace {

// 7 bands: 12 components and the mean of 49 coefficients are 637; light comes after.
TEST(FrameCost, LightAfterWeights) {
    const TransferLayout grey{TransferKind::diffuse, 7, 1};
    const FrameCost coloured = svd_cost(grey, 12, true);
    EXPECT_EQ(coloured.decode_per_vertex, 637u);
    EXPECT_EQ(coloured.light_per_vertex, 147u);
    EXPECT_EQ(coloured.per_vertex(), 784u);
    EXPECT_EQ(coloured.cpu_per_frame, 0u);
    EXPECT_EQ(svd_cost(grey, 12, false).per_vertex(), 637u + 49u);
    const TransferLayout rgb{TransferKind::diffuse, 7, 3};
    for (const bool coloured_light : {false, true}) {
        EXPECT_EQ(svd_cost(rgb, 12, coloured_light).per_vertex(), 3u * (637u + 49u));
    }
}

TEST(FrameCost, LightBeforeWeights) {
    const TransferLayout grey{TransferKind::diffuse, 7, 1};
    const FrameCost one = cpca_cost(grey, 64, 24, 0, false);
    EXPECT_EQ(one.per_vertex(), 25u);
    EXPECT_EQ(one.cpu_per_frame, 64u * 25u * 49u);
    const FrameCost three = cpca_cost(grey, 64, 24, 0, true);
    EXPECT_EQ(three.per_vertex(), 75u);
    EXPECT_EQ(three.cpu_per_frame, 3u * 64u * 25u * 49u);
    // Bases of ten components in time are rebuilt first, once for all channels of light.
    EXPECT_EQ(cpca_cost(grey, 64, 24, 10, true).cpu_per_frame, (3u + 10u) * 64u * 25u * 49u);
    const TransferLayout rgb{TransferKind::diffuse, 7, 3};
    EXPECT_EQ(cpca_cost(rgb, 64, 24, 10, true).cpu_per_frame, (3u + 30u) * 64u * 25u * 49u);
    EXPECT_EQ(cpca_cost(rgb, 64, 24, 0, false).per_vertex(), 75u);
    // Does not overflow.
    EXPECT_GT(cpca_cost(rgb, 1u << 20, 1u << 12, 0, true).cpu_per_frame, uint64_t{1} << 38);
}

TEST(FrameCost, Positions) {
    EXPECT_EQ(positions_cost(9).per_vertex(), 30u);
    EXPECT_EQ(positions_cost(0).per_vertex(), 3u);
}

}  // namespace
}  // namespace paim
