// PNG files: what another decoder reads back, and failures that leave nothing behind.
#include "paim/image/png.h"

#include <gtest/gtest.h>

#include "paim/base/error.h"
#include "tests/read_png.h"
#include "tests/temporary_directory.h"

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
    const PngPicture picture = read_png(directory / "a.png");
    ASSERT_EQ(picture.width, 3);
    ASSERT_EQ(picture.height, 2);
    for (int i = 0; i < 6; ++i) {
        const auto [red, green, blue] = picture.pixels[static_cast<size_t>(i)];
        EXPECT_EQ(red, curve.apply(0.1f * static_cast<float>(i)));
        EXPECT_EQ(green, 255);
        EXPECT_EQ(blue, 0);
    }
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
