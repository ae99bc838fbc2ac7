// Levels of an image: sizes, means in linear light, and samples between them.
#include "paim/image/mip_pyramid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/image/tone.h"

namespace paim {
namespace {

DecodedTexture image_of(int width, int height, std::vector<Rgb8> pixels) {
    return {width, height, std::move(pixels)};
}

Rgb8 grey(uint8_t value) {
    return {value, value, value};
}

// A display value is rounded to the nearest of 255 steps; the curve is steepest at white, where a
// step of it is 1 / 255 · 2.4 / 1.055 of linear light.
constexpr float kHalfStep = 0.5f / 255.0f * 2.4f / 1.055f;

TEST(MipPyramid, HalvesSizesDownToOnePixel) {
    const MipPyramid pyramid(image_of(20, 3, std::vector<Rgb8>(60)));
    std::vector<std::pair<int, int>> sizes;
    for (const DecodedTexture& level : pyramid.levels()) {
        sizes.emplace_back(level.width, level.height);
        EXPECT_EQ(level.pixels.size(), static_cast<size_t>(level.width * level.height));
    }
    EXPECT_EQ(sizes, (std::vector<std::pair<int, int>>{{20, 3}, {10, 1}, {5, 1}, {2, 1}, {1, 1}}));
}

TEST(MipPyramid, AConstantImageStaysConstant) {
    for (const auto& [width, height] : {std::pair(1, 1), {16, 16}, {31, 7}, {640, 3}}) {
        const Rgb8 color{1, 77, 254};
        const MipPyramid pyramid(
            image_of(width, height, std::vector<Rgb8>(static_cast<size_t>(width * height), color)));
        for (const DecodedTexture& level : pyramid.levels()) {
            for (const Rgb8& pixel : level.pixels) EXPECT_EQ(pixel, color);
        }
        // A bilinear sample of equal values, but for rounding of its four weights.
        const Vec3f at = pyramid.sample(0.3f, -7.77f, 0.5f);
        EXPECT_LE((at - srgb_to_linear(color)).cwiseAbs().maxCoeff(), 1e-6f);
    }
}

// Half black and half white is half of the light of white, 188 of 255, and not the display value 128.
TEST(MipPyramid, AveragesLinearLight) {
    const MipPyramid pyramid(image_of(2, 2, {grey(0), grey(255), grey(255), grey(0)}));
    EXPECT_EQ(pyramid.levels()[1].pixels[0], grey(ToneCurve{}.apply(0.5f)));
    EXPECT_EQ(pyramid.levels()[1].pixels[0], grey(188));
}

// Five pixels become two: each is the mean of two and a half.
TEST(MipPyramid, CoversAllOfOddSizes) {
    const MipPyramid pyramid(image_of(5, 1, {grey(255), grey(0), grey(255), grey(0), grey(0)}));
    const auto& half = pyramid.levels()[1];
    EXPECT_EQ(half.pixels[0], grey(ToneCurve{}.apply(1.5f / 2.5f)));
    EXPECT_EQ(half.pixels[1], grey(ToneCurve{}.apply(0.5f / 2.5f)));
    // Levels come from means before they were rounded.
    EXPECT_EQ(pyramid.levels()[2].pixels[0], grey(ToneCurve{}.apply(2.0f / 5.0f)));
}

// The mean of all pixels is that of the image at each level, although sizes are odd.
TEST(MipPyramid, EachLevelHasTheMeanOfTheImage) {
    std::vector<Rgb8> pixels;
    for (int i = 0; i < 37 * 23; ++i) pixels.push_back(grey(static_cast<uint8_t>(i * i % 251)));
    const MipPyramid pyramid(image_of(37, 23, pixels));
    const auto mean = [](const DecodedTexture& level) {
        double sum = 0.0;
        for (const Rgb8& pixel : level.pixels) sum += srgb_to_linear(pixel[0]);
        return sum / static_cast<double>(level.pixels.size());
    };
    for (const DecodedTexture& level : pyramid.levels()) {
        EXPECT_NEAR(mean(level), mean(pyramid.levels()[0]), kHalfStep) << level.width;
    }
}

TEST(MipPyramid, SamplesPixelsAtTheirCentresUpwards) {
    const std::vector<Rgb8> pixels{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {9, 9, 9}};
    const MipPyramid pyramid(image_of(2, 2, pixels));
    const auto color_at = [&](float u, float v) { return pyramid.sample(u, v, 0.0f); };
    EXPECT_EQ(color_at(0.25f, 0.75f), Vec3f(1, 0, 0));
    EXPECT_EQ(color_at(0.75f, 0.75f), Vec3f(0, 1, 0));
    EXPECT_EQ(color_at(0.25f, 0.25f), Vec3f(0, 0, 1));
    // The image repeats, and its right edge meets its left one.
    EXPECT_EQ(color_at(-1.75f, 3.75f), Vec3f(1, 0, 0));
    EXPECT_EQ(color_at(0.0f, 0.75f), Vec3f(0.5f, 0.5f, 0));
    EXPECT_EQ(color_at(1.0f, 0.75f), Vec3f(0.5f, 0.5f, 0));
    EXPECT_EQ(color_at(0.25f, 0.0f), Vec3f(0.5f, 0, 0.5f));
}

TEST(MipPyramid, InterpolatesLevels) {
    const MipPyramid pyramid(image_of(2, 2, {grey(0), grey(255), grey(255), grey(0)}));
    const float mean = srgb_to_linear(188);
    EXPECT_EQ(pyramid.sample(0.75f, 0.75f, -3.0f).x(), 1.0f);
    EXPECT_FLOAT_EQ(pyramid.sample(0.75f, 0.75f, 0.25f).x(), 0.75f + 0.25f * mean);
    EXPECT_FLOAT_EQ(pyramid.sample(0.75f, 0.75f, 9.0f).x(), mean);
}

TEST(MipPyramid, LevelIsOfTheLongerStep) {
    const MipPyramid pyramid(image_of(64, 16, std::vector<Rgb8>(64 * 16)));
    // One pixel of the image in x, four in y.
    EXPECT_FLOAT_EQ(pyramid.level({1.0f / 64.0f, 0.0f}, {0.0f, 4.0f / 16.0f}), 2.0f);
    EXPECT_FLOAT_EQ(pyramid.level({0.5f / 64.0f, 0.0f}, {0.0f, 0.5f / 16.0f}), -1.0f);
    // No step at all is the finest level there is.
    EXPECT_EQ(pyramid.sample(0.1f, 0.1f, pyramid.level(Vec2f::Zero(), Vec2f::Zero())),
              pyramid.sample(0.1f, 0.1f, 0.0f));
}

}  // namespace
}  // namespace paim
