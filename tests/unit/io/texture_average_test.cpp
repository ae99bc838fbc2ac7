// Averages of images within triangles, against areas.
#include "compressor/io/texture_average.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

namespace paim {
namespace {

constexpr Rgb8 kLeft{255, 0, 0}, kRight{0, 0, 255};

// The left part of the image is red, the right one blue.
MipPyramid halves(int width, int height) {
    DecodedTexture image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        image.pixels.push_back(i % width < width / 2 ? kLeft : kRight);
    }
    return MipPyramid(std::move(image));
}

// To roundings of floats.
void expect_color(const Vec3d& color, const Vec3d& expected) {
    EXPECT_LT((color - expected).cwiseAbs().maxCoeff(), 1e-5) << color.transpose();
}

TEST(TextureAverage, StaysWithinTheTriangle) {
    const MipPyramid image = halves(256, 128);
    const TextureAverage red = average_of(image, {Vec2f(0, 0), Vec2f(0.5f, 0), Vec2f(0, 1)});
    EXPECT_DOUBLE_EQ(red.area, 0.25);
    // The samples are between the levels of pixels of 4 and of 8 columns. They mix the halves within
    // half a pixel of where these meet, by half at most: in 4 of the 128 columns of the triangle at
    // each end, as the image repeats, which are at most twice as high as they are on average.
    constexpr double kMixed = 2.0 * 2.0 * 4.0 / 128.0 / 2.0;
    EXPECT_GT(red.color[0], 1.0 - kMixed);
    EXPECT_LT(red.color[2], kMixed);
    const TextureAverage blue =
        average_of(image, {Vec2f(0.55f, 0.2f), Vec2f(0.95f, 0.2f), Vec2f(0.95f, 0.8f)});
    expect_color(blue.color, Vec3d(0, 0, 1));
    // Both halves alike.
    const TextureAverage both = average_of(image, {Vec2f(0, 0), Vec2f(1, 0), Vec2f(0.5f, 1)});
    expect_color(both.color, Vec3d(0.5, 0, 0.5));
}

TEST(TextureAverage, HoldsForTrianglesOfAnyShape) {
    const MipPyramid image = halves(64, 64);
    const TextureAverage huge = average_of(image, {Vec2f(0, 0), Vec2f(1e6f, 0), Vec2f(0, 1e6f)});
    // The last level is rounded to 8 bits of sRGB, to 0.497 or 0.503 here.
    EXPECT_LT((huge.color - Vec3d(0.5, 0, 0.5)).cwiseAbs().maxCoeff(), 4e-3);
    // A point, and lines within one half and across both.
    const Vec2f left(0.25f, 0.5f), right(0.75f, 0.5f);
    expect_color(average_of(image, {left, left, left}).color, Vec3d(1, 0, 0));
    EXPECT_EQ(average_of(image, {right, right, right}).area, 0.0);
    expect_color(average_of(image, {right, right, Vec2f(0.6f, 0.1f)}).color, Vec3d(0, 0, 1));
    // Of a triangle with two corners at the left end of a line, three quarters are left of its
    // middle.
    expect_color(average_of(image, {left, right, left}).color, Vec3d(0.75, 0, 0.25));
    // Places that repeat, and far away: numbers at 2^20 have steps of 1/8.
    for (const float far : {-3.0f, 1048576.0f}) {
        const Vec2f shift(far, -far);
        const TextureAverage moved = average_of(
            image, {left + shift, Vec2f(0.25f, 0.25f) + shift, Vec2f(0.125f, 0.5f) + shift});
        expect_color(moved.color, Vec3d(1, 0, 0));
    }
    constexpr float kMost = std::numeric_limits<float>::max();
    const TextureAverage extreme =
        average_of(image, {Vec2f(-kMost, kMost), Vec2f(kMost, kMost), Vec2f(kMost, -kMost)});
    EXPECT_TRUE(extreme.color.allFinite());
}

TEST(TextureAverage, UIsToTheRightAndVUpwards) {
    DecodedTexture image{2, 2, {kLeft, kRight, {0, 255, 0}, {255, 255, 255}}};
    const MipPyramid pyramid(std::move(image));
    const auto at = [&](float u, float v) {
        const Vec2f place(u, v);
        return average_of(pyramid, {place, place, place}).color;
    };
    expect_color(at(0.25f, 0.75f), Vec3d(1, 0, 0));
    expect_color(at(0.75f, 0.75f), Vec3d(0, 0, 1));
    expect_color(at(0.25f, 0.25f), Vec3d(0, 1, 0));
    expect_color(at(0.75f, 0.25f), Vec3d(1, 1, 1));
}

}  // namespace
}  // namespace paim
