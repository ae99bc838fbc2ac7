// The cubic ramp that shapes and motions are blended with.
#pragma once

#include <algorithm>

namespace paim::poses {

// 0 up to `low`, 1 from `high` (> low), with level ends between.
inline double smoothstep(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

}  // namespace paim::poses
