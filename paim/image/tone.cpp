// Exposure, the operator, then the sRGB curve or a power.
// Based on: IEC 61966-2-1, Default RGB colour space sRGB, 1999; for the operators see the header
#include "paim/image/tone.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

// exposed  above 0
// returns  0 … 1
float share_of_white(float exposed, ToneOperator tone_operator) {
    const float x = std::min(exposed, ToneCurve::kLargestExposed);
    switch (tone_operator) {
        case ToneOperator::clamp:
            break;
        case ToneOperator::reinhard:
            return x / (1.0f + x);
        case ToneOperator::aces:
            return std::min(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 1.0f);
    }
    return std::min(x, 1.0f);
}

}  // namespace

std::vector<std::pair<std::string, ToneOperator>> tone_operator_names() {
    return {{"clamp", ToneOperator::clamp},
            {"reinhard", ToneOperator::reinhard},
            {"aces", ToneOperator::aces}};
}

std::string tone_operator_name(ToneOperator tone_operator) {
    for (const auto& [name, value] : tone_operator_names()) {
        if (value == tone_operator) return name;
    }
    return "";
}

ToneOperator parse_tone_operator(std::string_view text) {
    std::string expected;
    for (const auto& [name, value] : tone_operator_names()) {
        if (name == text) return value;
        expected += (expected.empty() ? "" : ", ") + name;
    }
    throw_usage("--tone-map: expected one of {}, got '{}'", expected, text);
}

uint8_t ToneCurve::apply(float linear) const {
    const float exposed = linear * std::exp2(exposure_ev);
    if (!(exposed > 0.0f)) return 0;  // also NaN
    const float x = share_of_white(exposed, tone_operator);
    float display = 0.0f;
    if (gamma > 0.0f) {
        display = std::pow(x, 1.0f / gamma);
    } else if (x <= 0.0031308f) {
        display = 12.92f * x;
    } else {
        display = 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    }
    return static_cast<uint8_t>(255.0f * display + 0.5f);
}

float ToneCurve::white() const {
    float exposed = 1.0f;
    if (tone_operator == ToneOperator::reinhard) exposed = std::numeric_limits<float>::infinity();
    // Where the fit is 1: 0.08 x² − 0.56 x − 0.14 = 0.
    if (tone_operator == ToneOperator::aces) exposed = 3.5f + std::sqrt(14.0f);
    return exposed * std::exp2(-exposure_ev);
}

std::vector<std::array<uint8_t, 3>> tone_map(const Image& image, const ToneCurve& curve) {
    std::vector<std::array<uint8_t, 3>> display(image.pixels.size());
    parallel_for(display.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            const Vec3f& pixel = image.pixels[i];
            display[i] = {curve.apply(pixel.x()), curve.apply(pixel.y()), curve.apply(pixel.z())};
        }
    });
    return display;
}

float suggested_exposure_ev(std::span<const Vec3f> radiance) {
    std::vector<float> brightness;
    for (const Vec3f& value : radiance) {
        const float largest = value.maxCoeff();
        if (largest > 0.0f && std::isfinite(largest)) brightness.push_back(largest);
    }
    if (brightness.empty()) return 0.0f;
    const auto at = brightness.begin() + static_cast<ptrdiff_t>(brightness.size() * 49 / 50);
    std::nth_element(brightness.begin(), at, brightness.end());
    return -std::log2(*at);
}

float suggested_exposure_ev(const Image& image) {
    return suggested_exposure_ev(image.pixels);
}

}  // namespace paim
