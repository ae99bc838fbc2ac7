// Colours that stand for numbers, as linear RGB of 0 … 1.
#pragma once

#include <cstdint>

#include "paim/base/vector.h"

namespace paim::player {

// Of values that are not a number. No scale has this colour.
inline const Vec3f kNotANumberColor(1.0f, 0.0f, 1.0f);

// Red for values above zero, blue for those below, light grey at zero. Luminance falls on both
// sides. Values beyond ±scale have the colour of ±scale. A scale that is not above zero gives grey.
// Based on: Moreland, Diverging Color Maps for Scientific Visualization, 2009 (its three colours)
Vec3f signed_color(float value, float scale);

// Dark violet at 0 to yellow at 1, luminance rising all the way; fractions outside have the colour of
// the nearer end.
// Based on: van der Walt and Smith, the colour map viridis of Matplotlib, 2015
Vec3f heat_color(float fraction);

// Colours of a list without an order. Hues of successive numbers lie a golden section of the circle
// apart, so that the hues of the first n numbers are well spread for every n.
Vec3f category_color(uint32_t index);

}  // namespace paim::player
