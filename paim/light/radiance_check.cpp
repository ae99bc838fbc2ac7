// Whether the pixels of a map are radiance.
#include "paim/light/radiance_check.h"

#include <cmath>

#include "paim/base/error.h"

namespace paim {

namespace {

// Largest ratio of negative to positive values of a map. Lossy compression and filters make dark
// rims around bright lights slightly negative (0.5 % in the maps seen so far). A map with more is
// not radiance.
constexpr double kMaxNegativeEnergy = 0.05;

}  // namespace

void RadianceCheck::add(int x, int y, std::span<const Vec3f> pixels, double weight) {
    for (const Vec3f& pixel : pixels) {
        for (const float value : pixel) {
            if (!std::isfinite(value)) {
                throw_bad_input("environment light: pixel ({}, {}) is {}, expected finite", x, y,
                                value);
            }
            (value < 0.0f ? negative_ : positive_) += weight * std::abs(value);
            if (value < worst_) {
                worst_ = value;
                worst_x_ = x;
                worst_y_ = y;
            }
        }
        ++x;
    }
}

void RadianceCheck::finish() const {
    if (negative_ <= kMaxNegativeEnergy * positive_) return;
    throw_bad_input(
        "environment light: pixel ({}, {}) is {}, and values below zero sum to {:.2g} of those "
        "above; expected at most {}",
        worst_x_, worst_y_, worst_, negative_ / positive_, kMaxNegativeEnergy);
}

}  // namespace paim
