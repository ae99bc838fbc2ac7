// Axis-aligned bounds.
#pragma once

#include <limits>
#include <span>

#include "paim/base/vector.h"

namespace paim {

template <typename Scalar>
struct BoundsOf {
    using Vector = Eigen::Matrix<Scalar, 3, 1>;

    Vector lower = Vector::Constant(std::numeric_limits<Scalar>::infinity());
    Vector upper = Vector::Constant(-std::numeric_limits<Scalar>::infinity());

    bool empty() const { return !(lower.array() <= upper.array()).all(); }
    void extend(const Vector& point) {
        lower = lower.cwiseMin(point);
        upper = upper.cwiseMax(point);
    }
    void extend(std::span<const Vector> points) {
        for (const Vector& point : points) extend(point);
    }
    void extend(const BoundsOf& other) {
        lower = lower.cwiseMin(other.lower);
        upper = upper.cwiseMax(other.upper);
    }
    Vector center() const { return Scalar(0.5) * lower + Scalar(0.5) * upper; }
    // Length of the diagonal, scene units; 0 when empty.
    Scalar diagonal() const { return empty() ? Scalar(0) : Vector(upper - lower).stableNorm(); }
};

using Bounds = BoundsOf<float>;
using BoundsD = BoundsOf<double>;

}  // namespace paim
