// Images on a square that fills the picture: pixels of the picture are those of the image.
#include "paim/render/textured.h"

#include <gtest/gtest.h>

#include <cmath>

namespace paim {
namespace {

constexpr int kSize = 32;

// The square from −1 to 1, which the camera sees as the whole picture.
struct Square {
    explicit Square(float scale) {
        for (Vec3f& x : positions) x *= scale;
        camera.eye = Vec3f(0, 0, 2.0f * scale);
        camera.vertical_fov_rad = 2.0f * std::atan(0.5f);
    }
    Topology topology{4, {{0, 1, 2}, {0, 2, 3}}};
    std::vector<Vec3f> positions{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    Camera camera;
};

// repeats  how often the image fits into each side
Texture square_texture(float repeats) {
    Texture texture;
    texture.images.emplace_back();
    texture.coordinates = {{0, 0}, {repeats, 0}, {repeats, repeats}, {0, repeats}};
    texture.corners = {{0, 1, 2}, {0, 2, 3}};
    texture.image_of_face = {1, 1};
    texture.factors = {Vec3f(0.5f, 1.0f, 0.25f)};
    return texture;
}

std::vector<MipPyramid> square_pyramids() {
    DecodedTexture image{kSize, kSize, {}};
    for (int i = 0; i < kSize * kSize; ++i) {
        image.pixels.push_back({static_cast<uint8_t>(7 * i), static_cast<uint8_t>(i * i % 251),
                                static_cast<uint8_t>(i % 13 * 19)});
    }
    std::vector<MipPyramid> pyramids;
    pyramids.emplace_back(std::move(image));
    return pyramids;
}

// White radiance grows from 1 on the left to 3 on the right.
Image draw(const Square& square, const Texture& texture, std::span<const MipPyramid> pyramids) {
    const std::vector<Vec3f> white{Vec3f::Ones(), Vec3f::Constant(3), Vec3f::Constant(3),
                                   Vec3f::Ones()};
    Image image(kSize, kSize, Vec3f(7, 8, 9));
    draw_texture(find_visible(square.topology, square.positions, square.camera, kSize, kSize),
                 square.topology, square.positions, square.camera, texture, pyramids, white, image);
    return image;
}

// Directions of rays are rounded to 2^-24, which moves places by some 2^-22 of the square: 2^-17 pixels of the
// image, over which a value changes by at most 1, times the radiance, at most 3. The level is off by
// as little, and mixes as little of the next one.
constexpr float kRounding = 2.0f * 3.0f * 0x1p-16f;

void expect_pixels(const Image& drawn, const DecodedTexture& level, const char* what) {
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const size_t at = static_cast<size_t>(y % level.height * level.width + x % level.width);
            const float white = 1.0f + 2.0f * (static_cast<float>(x) + 0.5f) / kSize;
            const Vec3f expected =
                white * srgb_to_linear(level.pixels[at]).cwiseProduct(Vec3f(0.5f, 1.0f, 0.25f));
            ASSERT_LE((drawn.at(x, y) - expected).cwiseAbs().maxCoeff(), kRounding)
                << what << ' ' << x << ' ' << y;
        }
    }
}

TEST(DrawTexture, ShowsEachPixelOfTheImage) {
    const auto pyramids = square_pyramids();
    // Scaling by powers of two is exact.
    for (const int exponent : {0, -100, 100}) {
        const Square square(std::ldexp(1.0f, exponent));
        expect_pixels(draw(square, square_texture(1.0f), pyramids), pyramids[0].levels()[0],
                      "level 0");
    }
}

TEST(DrawTexture, ShowsTheLevelThatAPixelCovers) {
    const auto pyramids = square_pyramids();
    const Square square(1.0f);
    expect_pixels(draw(square, square_texture(2.0f), pyramids), pyramids[0].levels()[1], "level 1");
    expect_pixels(draw(square, square_texture(8.0f), pyramids), pyramids[0].levels()[3], "level 3");
}

TEST(DrawTexture, LeavesFacesWithoutAnImage) {
    const auto pyramids = square_pyramids();
    const Square square(1.0f);
    Texture texture = square_texture(1.0f);
    texture.image_of_face = {1, 0};
    const Image image = draw(square, texture, pyramids);
    // The second triangle is the upper left one.
    EXPECT_EQ(image.at(3, 3), Vec3f(7, 8, 9));
    EXPECT_NE(image.at(kSize - 3, kSize - 3), Vec3f(7, 8, 9));
    // Triangles beyond the texture's have no image.
    texture.image_of_face = {1};
    EXPECT_EQ(draw(square, texture, pyramids).at(3, 3), Vec3f(7, 8, 9));
}

}  // namespace
}  // namespace paim
