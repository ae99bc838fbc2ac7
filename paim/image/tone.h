// The tone curve from linear radiance to display values.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "paim/image/image.h"

namespace paim {

// How linear radiance becomes a display value: scale by 2^exposure_ev, clamp to [0, 1], then the
// sRGB curve (gamma 0) or x^(1/gamma).
struct ToneCurve {
    float exposure_ev = 0.0f;
    float gamma = 0.0f;

    uint8_t apply(float linear) const;  // NaN gives 0
};

// [height · width] display values.
std::vector<std::array<uint8_t, 3>> tone_map(const Image& image, const ToneCurve& curve);

// The exposure in stops at which 98 % of the pixels that are not black stay below white. 0 for a
// black image.
float suggested_exposure_ev(const Image& image);

}  // namespace paim
