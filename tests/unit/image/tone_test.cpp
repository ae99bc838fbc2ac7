// The tone curve at values known from the sRGB standard, at its ends, and on odd numbers.
#include "paim/image/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paim {
namespace {

TEST(ToneCurve, IsSrgbByDefault) {
    const ToneCurve curve;
    EXPECT_EQ(curve.apply(0.0f), 0);
    EXPECT_EQ(curve.apply(1.0f), 255);
    // Middle grey, 0.18: 255 · (1.055 · 0.18^(1/2.4) − 0.055) = 117.7.
    EXPECT_EQ(curve.apply(0.18f), 118);
    // On the linear piece: 255 · 12.92 · 0.002 = 6.59.
    EXPECT_EQ(curve.apply(0.002f), 7);
}

TEST(ToneCurve, InvertsTheStandardDecoding) {
    // Decoding a display value by the standard and encoding it again gives it back.
    const ToneCurve curve;
    for (int value = 0; value < 256; ++value) {
        const double x = value / 255.0;
        const double linear = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
        EXPECT_EQ(curve.apply(static_cast<float>(linear)), value);
    }
}

TEST(ToneCurve, AppliesExposureAndGamma) {
    // 2^-2 · 1 = 0.25, its square root 0.5, 255 · 0.5 + 0.5 = 128.
    EXPECT_EQ((ToneCurve{-2.0f, 2.0f}).apply(1.0f), 128);
    EXPECT_EQ((ToneCurve{1.0f, 1.0f}).apply(0.25f), 128);
}

TEST(ToneCurve, ClampsAndSurvivesOddNumbers) {
    const ToneCurve curve;
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_EQ(curve.apply(-1.0f), 0);
    EXPECT_EQ(curve.apply(1e30f), 255);
    EXPECT_EQ(curve.apply(infinity), 255);
    EXPECT_EQ(curve.apply(-infinity), 0);
    EXPECT_EQ(curve.apply(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(ToneMap, KeepsOrderAndChannels) {
    Image image(2, 1);
    image.at(0, 0) = Vec3f(1, 0, 0);
    image.at(1, 0) = Vec3f(0, 0, 1);
    const auto display = tone_map(image, {});
    ASSERT_EQ(display.size(), 2u);
    EXPECT_EQ(display[0], (std::array<uint8_t, 3>{255, 0, 0}));
    EXPECT_EQ(display[1], (std::array<uint8_t, 3>{0, 0, 255}));
}

TEST(SuggestedExposure, BringsNearlyAllPixelsBelowWhite) {
    EXPECT_EQ(suggested_exposure_ev(Image(4, 4)), 0.0f);
    Image image(10, 10, Vec3f(1.0f, 4.0f, 2.0f));
    EXPECT_FLOAT_EQ(suggested_exposure_ev(image), -2.0f);
    image.at(3, 3) = Vec3f::Constant(1e6f);  // one lamp in the picture does not make all else black
    EXPECT_FLOAT_EQ(suggested_exposure_ev(image), -2.0f);
}

}  // namespace
}  // namespace paim
