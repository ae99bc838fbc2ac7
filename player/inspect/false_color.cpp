// Colour scales as lines between a few colours, in linear RGB: luminance is linear between two of
// them, so that it rises along the scale if it does from colour to colour.
#include "player/inspect/false_color.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace paim::player {

namespace {

// A colour of a published map, 0xRRGGBB in sRGB, as linear RGB.
Vec3f from_srgb(uint32_t rgb) {
    const auto linear = [](uint32_t byte) {
        const float s = static_cast<float>(byte) / 255.0f;
        return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
    };
    return {linear(rgb >> 16), linear(rgb >> 8 & 255), linear(rgb & 255)};
}

Vec3f between(const Vec3f& from, const Vec3f& to, float fraction) {
    return from + fraction * (to - from);
}

}  // namespace

Vec3f signed_color(float value, float scale) {
    static const Vec3f kNeutral = from_srgb(0xdddddd);
    static const Vec3f kAbove = from_srgb(0xb40426);
    static const Vec3f kBelow = from_srgb(0x3b4cc0);
    if (std::isnan(value) || std::isnan(scale)) return kNotANumberColor;
    if (value == 0.0f || scale <= 0.0f) return kNeutral;
    return between(kNeutral, value > 0.0f ? kAbove : kBelow,
                   std::min(std::abs(value) / scale, 1.0f));
}

Vec3f heat_color(float fraction) {
    static const std::array kColors{from_srgb(0x440154), from_srgb(0x482878), from_srgb(0x3e4989),
                                    from_srgb(0x31688e), from_srgb(0x26828e), from_srgb(0x1f9e89),
                                    from_srgb(0x35b779), from_srgb(0x6ece58), from_srgb(0xb5de2b),
                                    from_srgb(0xfde725)};
    if (std::isnan(fraction)) return kNotANumberColor;
    const float place = std::clamp(fraction, 0.0f, 1.0f) * static_cast<float>(kColors.size() - 1);
    const size_t before = std::min(static_cast<size_t>(place), kColors.size() - 2);
    return between(kColors[before], kColors[before + 1], place - static_cast<float>(before));
}

Vec3f category_color(uint32_t index) {
    constexpr double kGoldenSection = 0.61803398874989485;
    constexpr float kGreyShare = 0.12f;  // of white in each colour, so that none is too dark
    const double turns = std::fmod(kGoldenSection * index, 1.0);
    Vec3f color;
    for (int c = 0; c < 3; ++c) {
        // 1 at the hue of the channel, 0 from a third of the circle on.
        const double away = std::abs(std::fmod(turns - c / 3.0 + 1.5, 1.0) - 0.5);
        const auto share = static_cast<float>(std::clamp(2.0 - 6.0 * away, 0.0, 1.0));
        color[c] = kGreyShare + (0.9f - kGreyShare) * share;
    }
    return color;
}

}  // namespace paim::player
