// Pictures cut into tiles.
#include "player/render/tiles.h"

#include <gtest/gtest.h>

#include <array>

namespace paim::player {
namespace {

TEST(Tiles, AreOneWhereThePictureFits) {
    for (const auto& [width, height, samples] :
         {std::array{1280, 720, 2}, std::array{8192, 8192, 1}, std::array{2048, 512, 8}}) {
        const Tiling tiling = plan_tiles(width, height, samples, 16384);
        EXPECT_EQ(tiling.tile_width, width);
        EXPECT_EQ(tiling.tile_height, height);
        EXPECT_TRUE(tiling.region(0, 0).is_whole());
    }
}

TEST(Tiles, AreNeverLargerThanTheDriverDraws) {
    for (const int max_size : {8, 1024, 16384}) {
        for (const int samples : {1, 3, 8}) {
            for (const int width : {1, 511, 16384}) {
                for (const int height : {1, 700, 16384}) {
                    const Tiling tiling = plan_tiles(width, height, samples, max_size);
                    EXPECT_LE(tiling.tile_width * samples, max_size);
                    EXPECT_LE(tiling.tile_height * samples, max_size);
                    EXPECT_LE(int64_t{tiling.tile_width} * tiling.tile_height * samples * samples,
                              1 << 26);
                    EXPECT_GE(tiling.num_columns() * tiling.tile_width, width);
                    EXPECT_LT((tiling.num_columns() - 1) * tiling.tile_width, width);
                    EXPECT_GE(tiling.num_rows() * tiling.tile_height, height);
                    EXPECT_LT((tiling.num_rows() - 1) * tiling.tile_height, height);
                }
            }
        }
    }
}

// 100 × 50 pixels in tiles of 40 × 30: row 0 is at the top, the second row reaches below the picture.
TEST(Tiles, ShowTheirPartOfThePicture) {
    const Tiling tiling{100, 50, 40, 30};
    EXPECT_EQ(tiling.num_columns(), 3);
    EXPECT_EQ(tiling.num_rows(), 2);
    const PictureRegion region = tiling.region(1, 0);
    EXPECT_FLOAT_EQ(region.left, 0.4f);
    EXPECT_FLOAT_EQ(region.bottom, 0.4f);
    EXPECT_FLOAT_EQ(region.width, 0.4f);
    EXPECT_FLOAT_EQ(region.height, 0.6f);
    EXPECT_FLOAT_EQ(tiling.region(2, 1).left, 0.8f);
    EXPECT_FLOAT_EQ(tiling.region(2, 1).bottom, -0.2f);
}

TEST(Tiles, WindowsHaveTheSamplesThatFit) {
    EXPECT_EQ(samples_that_fit(1280, 720, 8, 16384), 8);
    EXPECT_EQ(samples_that_fit(3840, 2160, 8, 16384), 4);
    EXPECT_EQ(samples_that_fit(720, 9000, 8, 16384), 1);
    EXPECT_EQ(samples_that_fit(20000, 20000, 8, 16384), 1);
}

}  // namespace
}  // namespace paim::player
