// Exposure, then the sRGB curve or a power.
// Based on: IEC 61966-2-1, Default RGB colour space sRGB, 1999
#include "paim/image/tone.h"

#include <algorithm>
#include <cmath>

#include "paim/base/parallel.h"

namespace paim {

uint8_t ToneCurve::apply(float linear) const {
    const float exposed = linear * std::exp2(exposure_ev);
    if (!(exposed > 0.0f)) return 0;  // also NaN
    const float x = std::min(exposed, 1.0f);
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

float suggested_exposure_ev(const Image& image) {
    std::vector<float> brightness;
    for (const Vec3f& pixel : image.pixels) {
        const float largest = pixel.maxCoeff();
        if (largest > 0.0f && std::isfinite(largest)) brightness.push_back(largest);
    }
    if (brightness.empty()) return 0.0f;
    const auto at = brightness.begin() + static_cast<ptrdiff_t>(brightness.size() * 49 / 50);
    std::nth_element(brightness.begin(), at, brightness.end());
    return -std::log2(*at);
}

}  // namespace paim
