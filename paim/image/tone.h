// The tone curve from linear radiance to display values.
// Based on: Reinhard, Stark, Shirley and Ferwerda, Photographic Tone Reproduction for Digital Images, 2002
//           (ToneOperator::reinhard); Krzysztof Narkowicz, ACES Filmic Tone Mapping Curve, 2015
//           (ToneOperator::aces)
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "paim/image/image.h"

namespace paim {

// How exposed radiance x becomes a share of white, channel by channel.
enum class ToneOperator {
    clamp,     // min(x, 1)
    reinhard,  // x / (1 + x): equation 3 of Reinhard et al., for channels instead of luminance
    aces,      // Narkowicz's rational fit of the ACES reference rendering transform for sRGB
               // displays, x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14), at most 1. It leaves out
               // the fit's optional factor 0.6, so that it is brighter than ACES itself.
};

// The names on command lines and in reports.
std::vector<std::pair<std::string, ToneOperator>> tone_operator_names();
std::string tone_operator_name(ToneOperator tone_operator);
// Error (usage), which lists the names, if the text is none of them.
ToneOperator parse_tone_operator(std::string_view text);

// How linear radiance becomes a display value: scale by 2^exposure_ev, then the operator, then the
// sRGB curve (gamma 0) or x^(1/gamma). What is below zero becomes 0.
struct ToneCurve {
    // Exposed radiance is cut here, where each operator gives white to a thousandth of a display
    // value, so that squares of it stay finite.
    static constexpr float kLargestExposed = 1e6f;

    float exposure_ev = 0.0f;
    float gamma = 0.0f;
    ToneOperator tone_operator = ToneOperator::clamp;

    bool operator==(const ToneCurve&) const = default;

    uint8_t apply(float linear) const;  // NaN gives 0

    // The smallest radiance that the operator takes to 1; infinity if there is none.
    float white() const;
};

// [height · width] display values.
std::vector<std::array<uint8_t, 3>> tone_map(const Image& image, const ToneCurve& curve);

// The exposure in stops at which 98 % of what is not black has no channel above 1. 0 where all is
// black. Values that are not finite do not count.
float suggested_exposure_ev(std::span<const Vec3f> radiance);
float suggested_exposure_ev(const Image& image);

}  // namespace paim
