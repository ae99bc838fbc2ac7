// A colour channel of the transfer, or all three as one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "paim/transfer/layout.h"

namespace paim::player {

// Instead of a channel 0 … 2: the luminance of all three.
constexpr uint32_t kLuminance = 3;

// How much each channel of the layout counts. Grey transfer is its own luminance, and the same in
// every channel. Luminance is that of Rec. 709 (ITU-R BT.709-6, 3.2).
// channel  0 … 2, or kLuminance; others mean kLuminance
inline std::array<float, 3> channel_weights(const TransferLayout& layout, uint32_t channel) {
    if (layout.channels == 1) return {1.0f, 0.0f, 0.0f};
    std::array<float, 3> weights{0.2126f, 0.7152f, 0.0722f};
    if (channel < kLuminance) {
        weights = {};
        weights[channel] = 1.0f;
    }
    return weights;
}

}  // namespace paim::player
