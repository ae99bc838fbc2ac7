// The cubic ramp by which shapes and motions are blended.
#pragma once

#include <algorithm>

namespace paim::poses {

// 0 up to `low`, 1 from `high` (> low) on, and between them a cubic with slope 0 at both ends.
inline double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace paim::poses
