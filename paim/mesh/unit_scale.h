// A scale at which neither squares nor reciprocals of lengths leave the range of floats.
#pragma once

#include <algorithm>
#include <cmath>

namespace paim {

// The power of two that scales the length `largest` to 1 … 2, or as near as normal floats allow. 1
// if `largest` is 0 or not finite. Multiplying by a power of two is exact, so it only changes the
// unit.
inline float unit_scale(double largest) {
    if (!(largest > 0.0) || !std::isfinite(largest)) return 1.0f;
    return std::ldexp(1.0f, std::clamp(-std::ilogb(largest), -126, 126));
}

}  // namespace paim
