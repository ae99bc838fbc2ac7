// Decoded textures: all kinds of PNG, JPEG, and files that are refused.
#include "paim/image/texture_image.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <string>

#include "paim/base/error.h"
#include "paim/image/tone.h"
#include "tests/texture_bytes.h"

namespace paim {
namespace {

const std::vector<Rgb8> kSix{{10, 20, 30}, {255, 0, 0},    {0, 255, 0},
                             {0, 0, 255},  {200, 150, 99}, {1, 2, 3}};

std::string refused(const std::function<void()>& decode) {
    try {
        decode();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        return error.what();
    }
    return "not refused";
}

TEST(DecodeTexture, ReadsRgbFromTheTopRowOn) {
    const DecodedTexture texture = decode_texture(png_bytes(3, 2, kSix), "a.png");
    EXPECT_EQ(texture.width, 3);
    EXPECT_EQ(texture.height, 2);
    EXPECT_EQ(texture.pixels, kSix);
}

TEST(DecodeTexture, ReadsGreyAlphaPaletteAnd16Bits) {
    const std::vector<Rgb8> greys{{7, 7, 7}, {250, 250, 250}};
    const auto decode = [](int depth, PngColor color, const std::vector<uint8_t>& samples,
                           std::span<const Rgb8> palette = {}) {
        return decode_texture(png_file(2, 1, depth, color, samples, palette), "a").pixels;
    };
    EXPECT_EQ(decode(8, PngColor::grey, {7, 250}), greys);
    // Whatever the alpha.
    EXPECT_EQ(decode(8, PngColor::grey_alpha, {7, 0, 250, 99}), greys);
    const std::vector<Rgb8> colors{{1, 2, 3}, {40, 50, 60}};
    EXPECT_EQ(decode(8, PngColor::rgba, {1, 2, 3, 0, 40, 50, 60, 128}), colors);
    // The upper eight bits.
    EXPECT_EQ(decode(16, PngColor::rgb, {1, 255, 2, 0, 3, 9, 40, 0, 50, 128, 60, 255}), colors);
    EXPECT_EQ(decode(16, PngColor::grey, {7, 200, 250, 1}), greys);
    // Two pixels of four bits in a byte.
    EXPECT_EQ(decode(4, PngColor::palette, {0x10}, std::vector<Rgb8>{colors[1], colors[0]}),
              colors);
}

TEST(DecodeTexture, ReadsJpeg) {
    const std::vector<Rgb8> pixels(20 * 9, {200, 100, 50});
    const DecodedTexture texture = decode_texture(jpeg_bytes(20, 9, pixels, 100), "a.jpg");
    ASSERT_EQ(texture.width, 20);
    ASSERT_EQ(texture.height, 9);
    for (const Rgb8& pixel : texture.pixels) {
        for (size_t channel = 0; channel < 3; ++channel) {
            // Steps of 1 in luma and chroma at quality 100 are rounded to a half each, and chroma
            // counts at most 1.772 times (JFIF 1.02): at most 0.5 + 0.886, and a half more where the
            // decoder rounds.
            EXPECT_NEAR(pixel[channel], pixels[0][channel], 2);
        }
    }
}

TEST(DecodeTexture, RefusesWhatIsNoImage) {
    for (const std::string& text : {std::string(), std::string("GIF89a"), std::string("\x89PN")}) {
        const std::vector<uint8_t> bytes(text.begin(), text.end());
        EXPECT_EQ(refused([&] { decode_texture(bytes, "wood.png"); }),
                  "wood.png: neither a PNG nor a JPEG image");
    }
}

TEST(DecodeTexture, RefusesAllBeginningsOfAPng) {
    const std::vector<uint8_t> file = png_bytes(3, 2, kSix);
    // The last four bytes are a checksum, which the decoder passes over.
    for (size_t size = 8; size + 4 < file.size(); ++size) {
        const std::string message =
            refused([&] { decode_texture(std::span(file).first(size), "a.png"); });
        EXPECT_TRUE(message.starts_with("a.png: truncated or damaged image")) << size << message;
    }
}

TEST(DecodeTexture, RefusesAllBeginningsOfAJpeg) {
    const std::vector<Rgb8> pixels(64, {90, 80, 70});
    const std::vector<uint8_t> file = jpeg_bytes(8, 8, pixels, 90);
    for (size_t size = 3; size < file.size(); ++size) {
        const std::string message =
            refused([&] { decode_texture(std::span(file).first(size), "a.jpg"); });
        EXPECT_EQ(message, "a.jpg: truncated JPEG image") << size;
    }
}

TEST(DecodeTexture, NoByteOfAFileCanDoHarm) {
    const std::vector<Rgb8> pixels(64, {90, 80, 70});
    for (const std::vector<uint8_t>& file : {png_bytes(3, 2, kSix), jpeg_bytes(8, 8, pixels, 90)}) {
        for (size_t at = 0; at < file.size(); ++at) {
            for (const uint8_t flipped : {0x01, 0x80, 0xff}) {
                std::vector<uint8_t> damaged = file;
                damaged[at] = static_cast<uint8_t>(damaged[at] ^ flipped);
                try {
                    const DecodedTexture texture = decode_texture(damaged, "a", 100000);
                    EXPECT_EQ(texture.pixels.size(), static_cast<size_t>(texture.width) *
                                                         static_cast<size_t>(texture.height));
                } catch (const Error& error) {
                    EXPECT_EQ(error.code(), ExitCode::bad_input) << at;
                }
            }
        }
    }
}

TEST(DecodeTexture, RefusesMorePixelsThanItMay) {
    const std::vector<uint8_t> large = png_file(15000, 12000, 8, PngColor::rgb, {});
    EXPECT_EQ(refused([&] { decode_texture(large, "a.png"); }),
              "a.png: 15000 x 12000 pixels, expected at most 67108864");
    // So many that the decoder does not believe the header.
    const std::vector<uint8_t> huge = png_file(60000, 50000, 8, PngColor::rgb, {});
    EXPECT_EQ(refused([&] { decode_texture(huge, "a.png"); }),
              "a.png: truncated or damaged image (header)");
    const std::vector<uint8_t> small = png_bytes(3, 2, kSix);
    EXPECT_EQ(decode_texture(small, "a.png", 6).width, 3);
    EXPECT_EQ(refused([&] { decode_texture(small, "a.png", 5); }),
              "a.png: 3 x 2 pixels, expected at most 5");
}

// A file of one pixel that would be inflated to 8 MB.
TEST(DecodeTexture, InflatesNoMoreThanTheImageNeeds) {
    const std::vector<uint8_t> zeros(size_t{8} << 20);
    const std::vector<uint8_t> bomb = png_file(1, 1, 8, PngColor::grey, zeros);
    ASSERT_LT(bomb.size(), size_t{1} << 20);
    const std::string message = refused([&] { decode_texture(bomb, "a.png"); });
    EXPECT_TRUE(message.starts_with("a.png: truncated or damaged image (outofmem")) << message;
}

// Both directions of the curve of 8-bit images.
TEST(SrgbToLinear, IsTheInverseOfTheToneCurve) {
    EXPECT_EQ(srgb_to_linear(0), 0.0f);
    EXPECT_EQ(srgb_to_linear(255), 1.0f);
    // ((128/255 + 0.055) / 1.055)^2.4, and 10/255 / 12.92 of the straight part.
    EXPECT_NEAR(srgb_to_linear(128), 0.2158605, 1e-7);
    EXPECT_NEAR(srgb_to_linear(10), 0.0030353, 1e-7);
    for (int value = 0; value < 256; ++value) {
        const auto display = static_cast<uint8_t>(value);
        EXPECT_EQ(ToneCurve{}.apply(srgb_to_linear(display)), display);
    }
}

}  // namespace
}  // namespace paim
