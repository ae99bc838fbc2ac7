// Axis-aligned bounds.
#pragma once

#include <limits>
#include <span>

#include "paim/base/vector.h"

namespace paim {

struct Bounds {
    Vec3f lower = Vec3f::Constant(std::numeric_limits<float>::infinity());
    Vec3f upper = Vec3f::Constant(-std::numeric_limits<float>::infinity());

    bool empty() const { return !(lower.array() <= upper.array()).all(); }
    void extend(const Vec3f& point) {
        lower = lower.cwiseMin(point);
        upper = upper.cwiseMax(point);
    }
    void extend(std::span<const Vec3f> points) {
        for (const Vec3f& point : points) extend(point);
    }
    Vec3f center() const { return 0.5f * lower + 0.5f * upper; }
    // Length of the diagonal, scene units; 0 when empty.
    float diagonal() const { return empty() ? 0.0f : (upper - lower).stableNorm(); }
};

}  // namespace paim
