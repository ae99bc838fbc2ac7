// PNG files: what another decoder reads back, and failures that leave nothing behind.
#include "paim/image/png.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "tests/temporary_directory.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace paim {
namespace {

TEST(WritePng, IsReadBackByADecoder) {
    const TemporaryDirectory directory;
    Image image(3, 2);
    for (int i = 0; i < 6; ++i) {
        image.pixels[static_cast<size_t>(i)] = Vec3f(0.1f * static_cast<float>(i), 1.0f, 0.0f);
    }
    const ToneCurve curve{0.0f, 1.0f};
    write_png(directory / "a.png", image, curve);
    int width = 0, height = 0, channels = 0;
    unsigned char* pixels = stbi_load((directory / "a.png").c_str(), &width, &height, &channels, 0);
    ASSERT_NE(pixels, nullptr);
    ASSERT_EQ(width, 3);
    ASSERT_EQ(height, 2);
    ASSERT_EQ(channels, 3);
    for (int i = 0; i < 6; ++i) {
        EXPECT_EQ(pixels[3 * i], curve.apply(0.1f * static_cast<float>(i)));
        EXPECT_EQ(pixels[3 * i + 1], 255);
        EXPECT_EQ(pixels[3 * i + 2], 0);
    }
    stbi_image_free(pixels);
}

TEST(WritePng, FailsWithTheNameAndTheRightCode) {
    const TemporaryDirectory directory;
    try {
        write_png(directory / "none" / "a.png", Image(1, 1));
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::output_failed);
        EXPECT_NE(std::string(error.what()).find("none/a.png"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace paim
