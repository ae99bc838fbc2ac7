// The table of views, and colours that stand for numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "paim/base/error.h"
#include "player/inspect/false_color.h"
#include "player/inspect/legend.h"
#include "player/inspect/surface_view.h"
#include "player/inspect/transfer_channel.h"

namespace paim::player {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

float luminance(const Vec3f& color) {
    return color.dot(Vec3f(0.2126f, 0.7152f, 0.0722f));
}

TEST(SurfaceViews, AreFoundByTheirNames) {
    std::set<std::string_view> names, words, titles;
    for (const SurfaceViewRow& row : surface_views()) {
        EXPECT_EQ(parse_surface_view(row.name), row.view);
        EXPECT_EQ(row_of(row.view).name, row.name);
        EXPECT_EQ(row.description.back(), '.') << row.name;
        EXPECT_EQ(row.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz-"), row.name.npos);
        names.insert(row.name);
        words.insert(row.words);
        EXPECT_FALSE(legend_title(row.view, 0, 0).empty());
    }
    EXPECT_EQ(surface_views().size(), 10u);
    EXPECT_EQ(names.size(), 10u);
    EXPECT_EQ(words.size(), 10u);
}

TEST(SurfaceViews, UnknownNamesAreRefusedWithAListOfAll) {
    try {
        parse_surface_view("heat");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        EXPECT_NE(std::string(error.what()).find("'heat'"), std::string::npos);
        for (const SurfaceViewRow& row : surface_views()) {
            EXPECT_NE(std::string(error.what()).find(row.name), std::string::npos) << row.name;
        }
    }
    EXPECT_THROW(parse_surface_view(""), Error);
}

TEST(SurfaceViews, TitlesOfCoefficientsHaveDegreeOrderAndChannel) {
    EXPECT_EQ(legend_title(SurfaceView::coefficient, 5, 1),
              "transfer, l = 2, m = -1, green (no unit)");
    EXPECT_EQ(legend_title(SurfaceView::coefficient, 3, kLuminance),
              "transfer, l = 1, m = 1, luminance (no unit)");
}

TEST(SignedColor, IsGreyAtZeroRedAboveAndBlueBelow) {
    const Vec3f zero = signed_color(0.0f, 2.0f);
    EXPECT_EQ(zero.x(), zero.y());
    EXPECT_EQ(zero.x(), zero.z());
    const Vec3f above = signed_color(2.0f, 2.0f), below = signed_color(-2.0f, 2.0f);
    EXPECT_GT(above.x(), 3.0f * above.z());
    EXPECT_GT(below.z(), 3.0f * below.x());
    EXPECT_EQ(signed_color(9.0f, 2.0f), above);
    EXPECT_EQ(signed_color(-9.0f, 2.0f), below);
    EXPECT_EQ(signed_color(1.0f, 0.0f), zero);
    // Half of the way, in linear light.
    EXPECT_LT((signed_color(1.0f, 2.0f) - 0.5f * (zero + above)).norm(), 1e-6f);
    EXPECT_LT((signed_color(-1.0f, 2.0f) - 0.5f * (zero + below)).norm(), 1e-6f);
}

TEST(SignedColor, LuminanceFallsOnBothSides) {
    for (const float sign : {-1.0f, 1.0f}) {
        for (int j = 0; j < 100; ++j) {
            const auto step = static_cast<float>(j);
            EXPECT_GT(luminance(signed_color(sign * step, 100.0f)),
                      luminance(signed_color(sign * (step + 1.0f), 100.0f)));
        }
    }
}

TEST(HeatColor, LuminanceRises) {
    for (int j = 0; j < 1000; ++j) {
        const auto step = static_cast<float>(j);
        EXPECT_LT(luminance(heat_color(step / 1000.0f)),
                  luminance(heat_color((step + 1.0f) / 1000.0f)));
    }
    EXPECT_EQ(heat_color(-1.0f), heat_color(0.0f));
    EXPECT_EQ(heat_color(7.0f), heat_color(1.0f));
    EXPECT_EQ(heat_color(std::numeric_limits<float>::infinity()), heat_color(1.0f));
}

TEST(FalseColors, NotANumberLooksLikeNoNumber) {
    EXPECT_EQ(signed_color(kNaN, 1.0f), kNotANumberColor);
    EXPECT_EQ(signed_color(1.0f, kNaN), kNotANumberColor);
    EXPECT_EQ(heat_color(kNaN), kNotANumberColor);
    for (int j = -100; j <= 100; ++j) {
        const float value = static_cast<float>(j) / 100.0f;
        EXPECT_GT((signed_color(value, 1.0f) - kNotANumberColor).norm(), 0.3f);
        EXPECT_GT((heat_color(value) - kNotANumberColor).norm(), 0.3f);
    }
}

TEST(CategoryColor, TheFirstOnesAreFarApart) {
    for (uint32_t a = 0; a < 12; ++a) {
        const Vec3f color = category_color(a);
        EXPECT_GE(color.minCoeff(), 0.0f);
        EXPECT_LE(color.maxCoeff(), 1.0f);
        // Hues of n numbers lie at least 0.38 / n of the circle apart, over which a channel changes by
        // six times that and 0.78.
        for (uint32_t b = 0; b < a; ++b) {
            EXPECT_GT((color - category_color(b)).norm(), 6.0f * 0.38f / 12.0f * 0.78f) << a << b;
        }
    }
    EXPECT_LE(category_color(4000000000u).maxCoeff(), 1.0f);
}

}  // namespace
}  // namespace paim::player
