// The sRGB curve of 8-bit images, from display values to linear light. ToneCurve{}.apply() is its
// inverse.
// Based on: IEC 61966-2-1, Default RGB colour space sRGB, 1999
#pragma once

#include <array>
#include <cstdint>

#include "paim/base/vector.h"

namespace paim {

using Rgb8 = std::array<uint8_t, 3>;

// value    0 … 255
// returns  0 … 1
float srgb_to_linear(uint8_t value);

// The same for each channel.
Vec3f srgb_to_linear(const Rgb8& color);

}  // namespace paim
