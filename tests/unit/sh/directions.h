// Directions to test with: random ones, and those near the poles, where precision is lost first.
#pragma once

#include <cmath>
#include <vector>

#include "paim/base/seed.h"
#include "paim/base/vector.h"

namespace paim {

inline Vec3d random_direction(RandomStream& random) {
    const double z = 2.0 * random.uniform() - 1.0;
    const double phi = 2.0 * kPi * random.uniform();
    const double s = std::sqrt(1.0 - z * z);
    return Vec3d(s * std::cos(phi), s * std::sin(phi), z).normalized();
}

// 96 uniform ones, 90 within 1e-12 … 1 of a pole, and the six axes: 192, a multiple of 16.
inline std::vector<Vec3d> test_directions() {
    RandomStream random(stream_key(7, 0, 0));
    std::vector<Vec3d> directions;
    for (int i = 0; i < 96; ++i) directions.push_back(random_direction(random));
    for (int i = 0; i < 90; ++i) {
        const double s = std::pow(10.0, -12.0 * random.uniform());
        const double phi = 2.0 * kPi * random.uniform();
        directions.push_back(
            Vec3d(s * std::cos(phi), s * std::sin(phi), i % 2 == 0 ? 1.0 : -1.0).normalized());
    }
    for (int axis = 0; axis < 3; ++axis) {
        directions.push_back(Vec3d::Unit(axis));
        directions.push_back(-Vec3d::Unit(axis));
    }
    return directions;
}

// The largest value a function of band l takes.
inline double band_maximum(int l) {
    return std::sqrt((2.0 * l + 1.0) / (4.0 * kPi));
}

}  // namespace paim
