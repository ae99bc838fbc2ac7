// The scale at which single precision has room on both sides.
#pragma once

#include <algorithm>
#include <cmath>

namespace paim {

// The power of two that brings lengths of which the largest is `largest` to about 1: to 1 … 2, or as
// near as normal floats allow. Multiplying by it is exact, so it changes nothing but the unit, and
// then neither squares nor reciprocals of lengths leave the range of floats. 1 if `largest` is 0 or
// not finite.
inline float unit_scale(double largest) {
    if (!(largest > 0.0) || !std::isfinite(largest)) return 1.0f;
    return std::ldexp(1.0f, std::clamp(-std::ilogb(largest), -126, 126));
}

}  // namespace paim
