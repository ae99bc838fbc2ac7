// Block averages.
#include "paim/image/image.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(Downsample, AveragesBlocks) {
    Image image(6, 4);
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 6; ++x) {
            image.at(x, y) = Vec3f(static_cast<float>(x), static_cast<float>(y), 1.0f);
        }
    }
    const Image half = downsample(image, 2);
    ASSERT_EQ(half.width, 3);
    ASSERT_EQ(half.height, 2);
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 3; ++x) {
            // The mean of two neighbouring integers is exact in binary.
            const auto expected_x = static_cast<float>(2 * x) + 0.5f;
            const auto expected_y = static_cast<float>(2 * y) + 0.5f;
            EXPECT_EQ(half.at(x, y), Vec3f(expected_x, expected_y, 1.0f));
        }
    }
}

TEST(Downsample, ByOneIsTheImage) {
    Image image(3, 1);
    image.at(2, 0) = Vec3f(0.1f, 0.2f, 0.3f);
    EXPECT_EQ(downsample(image, 1).pixels, image.pixels);
}

TEST(DownsampleDeathTest, RefusesFactorsThatDoNotDivide) {
    EXPECT_DEATH(downsample(Image(3, 2), 2), "check failed.*width");
    EXPECT_DEATH(downsample(Image(2, 2), 0), "check failed");
}

}  // namespace
}  // namespace paim
