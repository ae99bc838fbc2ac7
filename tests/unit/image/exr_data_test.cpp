// Real pictures coded in different ways agree with one another; files damaged in the wild are
// survived.
#include <sys/resource.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>

#include "paim/base/error.h"
#include "paim/image/exr.h"

namespace paim {
namespace {

const std::filesystem::path kData = PAIM_DATA_DIR;

Image read_matrix(const std::string& name) {
    return read_exr(kData / "exr-matrix" / ("venice_" + name + ".exr"));
}

// Half's relative rounding is 2^-11, and 2^-25 is half its smallest step.
float half_tolerance(float value) {
    return std::abs(value) * 0x1.0p-11f + 0x1.0p-25f;
}

TEST(ExrData, SixCodingsOfOnePictureAgree) {
    const Image reference = read_matrix("zip_float");
    ASSERT_EQ(reference.width, 1024);
    ASSERT_EQ(reference.height, 512);
    const Image tiled = read_matrix("tiled64_zip_half");
    const Image rgba = read_matrix("rgba_zip_half");
    const Image grey = read_matrix("Y_zip_half");
    const Image cropped = read_matrix("datawindow_crop_zip_half");
    const Image lossy = read_matrix("dwaa_half");
    for (const Image* image : {&tiled, &rgba, &grey, &cropped, &lossy}) {
        ASSERT_EQ(image->width, reference.width);
        ASSERT_EQ(image->height, reference.height);
    }
    double lossy_error = 0.0;
    double sum = 0.0;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            const Vec3f& expected = reference.at(x, y);
            for (int c = 0; c < 3; ++c) {
                ASSERT_NEAR(tiled.at(x, y)[c], expected[c], half_tolerance(expected[c]));
            }
            ASSERT_EQ(rgba.at(x, y), tiled.at(x, y));
            const bool inside = x >= 60 && x < 960 && y >= 50 && y < 450;
            ASSERT_EQ(cropped.at(x, y), inside ? rgba.at(x, y) : Vec3f(0, 0, 0)) << x << " " << y;
            // The weights the file was made with; the sum is rounded to half once more.
            const float luminance = rgba.at(x, y).dot(Vec3f(0.2126f, 0.7152f, 0.0722f));
            ASSERT_NEAR(grey.at(x, y).x(), luminance, 2 * half_tolerance(luminance));
            ASSERT_EQ(grey.at(x, y), Vec3f(Vec3f::Constant(grey.at(x, y).x())));
            lossy_error += (lossy.at(x, y) - expected).cwiseAbs().sum();
            sum += expected.sum();
        }
    }
    // DWA at its default quality is meant to be invisible: 1 % on average is generous.
    EXPECT_LT(lossy_error, 0.01 * sum);
    EXPECT_GT(lossy_error, 0.0);
}

TEST(ExrData, ReadsTheEnvironmentMaps) {
    for (const char* name : {"venice", "forest", "night", "studio", "OrientationLatLong"}) {
        const Image image = read_exr(kData / "env" / (std::string(name) + ".exr"));
        EXPECT_EQ(image.width, 2 * image.height) << name;
        double sum = 0.0;
        for (const Vec3f& pixel : image.pixels) {
            ASSERT_TRUE(pixel.allFinite()) << name;
            sum += pixel.sum();
        }
        EXPECT_GT(sum, 0.0) << name;
    }
}

TEST(ExrData, SurvivesFilesDamagedInTheWild) {
    size_t num_files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(PAIM_DAMAGED_EXR_DIR)) {
        ++num_files;
        const auto start = std::chrono::steady_clock::now();
        try {
            const Image image = read_exr(entry.path());
            EXPECT_GT(image.pixels.size(), 0u);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input) << error.what();
            EXPECT_NE(std::string(error.what()).find(entry.path().string()), std::string::npos);
        }
        const std::chrono::duration<double> time_s = std::chrono::steady_clock::now() - start;
        EXPECT_LT(time_s.count(), 5.0) << entry.path();
    }
    EXPECT_EQ(num_files, 62u);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    EXPECT_LT(usage.ru_maxrss, 1 << 20);  // KiB: a gigabyte
}

}  // namespace
}  // namespace paim
