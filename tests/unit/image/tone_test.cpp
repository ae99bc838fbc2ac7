// The tone curve at values known from the sRGB standard, at its ends, and on odd numbers.
#include "paim/image/tone.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "paim/base/error.h"

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

// Display values of linear shares (gamma 1): 255 · share, rounded.
TEST(ToneCurve, OperatorsHaveTheirPublishedValues) {
    const ToneCurve reinhard{0.0f, 1.0f, ToneOperator::reinhard};
    EXPECT_EQ(reinhard.apply(1.0f), 128);  // 1/2
    EXPECT_EQ(reinhard.apply(3.0f), 191);  // 3/4
    EXPECT_EQ((ToneCurve{2.0f, 1.0f, ToneOperator::reinhard}).apply(0.25f), 128);
    const ToneCurve aces{0.0f, 1.0f, ToneOperator::aces};
    EXPECT_EQ(aces.apply(1.0f), 205);  // 2.54 / 3.16 = 0.8038
    EXPECT_EQ(aces.apply(0.18f), 68);  // 0.086724 / 0.324932 = 0.2669
    EXPECT_EQ(aces.apply(0.01f), 1);   // 0.000551 / 0.146143 = 0.0038
    EXPECT_EQ((ToneCurve{-3.0f, 1.0f, ToneOperator::aces}).apply(8.0f), 205);
    // Then the sRGB curve: 0.5 is 0.7354.
    EXPECT_EQ((ToneCurve{0.0f, 0.0f, ToneOperator::reinhard}).apply(1.0f), 188);
}

TEST(ToneCurve, OperatorsGrowUpToWhite) {
    for (const auto& [name, tone_operator] : tone_operator_names()) {
        const ToneCurve curve{0.0f, 0.0f, tone_operator};
        EXPECT_EQ(curve.apply(0.0f), 0) << name;
        EXPECT_EQ(curve.apply(-1.0f), 0) << name;
        EXPECT_EQ(curve.apply(std::numeric_limits<float>::quiet_NaN()), 0) << name;
        int before = 0;
        for (float x = 1e-5f; x < 1e38f; x *= 1.1f) {
            const int value = curve.apply(x);
            ASSERT_GE(value, before) << name << " " << x;
            before = value;
        }
        EXPECT_EQ(curve.apply(std::numeric_limits<float>::infinity()), 255) << name;
        EXPECT_EQ((ToneCurve{30.0f, 0.0f, tone_operator}).apply(3e38f), 255) << name;
    }
}

TEST(ToneCurve, WhiteIsWhereTheOperatorReachesOne) {
    const auto white = [](ToneOperator tone_operator, float exposure_ev) {
        return (ToneCurve{exposure_ev, 1.0f, tone_operator}).white();
    };
    EXPECT_EQ(white(ToneOperator::clamp, 0.0f), 1.0f);
    EXPECT_EQ(white(ToneOperator::clamp, -3.0f), 8.0f);
    EXPECT_EQ(white(ToneOperator::reinhard, 2.0f), std::numeric_limits<float>::infinity());
    EXPECT_NEAR(white(ToneOperator::aces, 0.0f), 7.2417f, 1e-4f);
    const ToneCurve aces{-1.0f, 1.0f, ToneOperator::aces};
    EXPECT_EQ(aces.apply(aces.white()), 255);
    EXPECT_LT(aces.apply(0.8f * aces.white()), 254);
}

TEST(ToneOperator, IsReadByName) {
    EXPECT_EQ(parse_tone_operator("clamp"), ToneOperator::clamp);
    EXPECT_EQ(parse_tone_operator("reinhard"), ToneOperator::reinhard);
    EXPECT_EQ(parse_tone_operator("aces"), ToneOperator::aces);
    EXPECT_EQ(tone_operator_name(ToneOperator::aces), "aces");
    for (const char* text : {"", "ACES", "filmic", "aces "}) {
        try {
            parse_tone_operator(text);
            FAIL() << "expected an error for '" << text << "'";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::usage);
            EXPECT_EQ(std::string(error.what()),
                      std::string("--tone-map: expected one of clamp, reinhard, aces, got '") +
                          text + "'");
        }
    }
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
    Image brighter = image;  // three of a hundred are more than 2 %
    brighter.at(4, 3) = brighter.at(5, 3) = Vec3f::Constant(32.0f);
    EXPECT_FLOAT_EQ(suggested_exposure_ev(brighter), -5.0f);
    // Nor do pixels that are black or not finite count.
    for (int x = 0; x < 10; ++x) image.at(x, 9) = Vec3f::Zero();
    image.at(0, 0) = Vec3f::Constant(std::numeric_limits<float>::infinity());
    EXPECT_FLOAT_EQ(suggested_exposure_ev(image), -2.0f);
}

}  // namespace
}  // namespace paim
