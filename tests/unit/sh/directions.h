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

// 96 uniform ones, 54 within 1e-20 … 1 of a pole, one 1e-3, 1e-4 … 1e-20 from each pole, and the
// six axes: 192, a multiple of 16.
inline std::vector<Vec3d> test_directions() {
    RandomStream random(stream_key(7, 0, 0));
    std::vector<Vec3d> directions;
    const auto add_near_pole = [&](double s, double pole) {
        const double phi = 2.0 * kPi * random.uniform();
        directions.push_back(Vec3d(s * std::cos(phi), s * std::sin(phi), pole).normalized());
    };
    for (int i = 0; i < 96; ++i) directions.push_back(random_direction(random));
    for (int i = 0; i < 54; ++i) {
        add_near_pole(std::pow(10.0, -20.0 * random.uniform()), i % 2 == 0 ? 1.0 : -1.0);
    }
    for (int exponent = -3; exponent >= -20; --exponent) {
        for (const double pole : {1.0, -1.0}) add_near_pole(std::pow(10.0, exponent), pole);
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
