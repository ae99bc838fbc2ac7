// Light of random coefficients.
#pragma once

#include <cstdint>

#include "paim/base/seed.h"
#include "paim/light/light.h"

namespace paim {

// Each channel of each coefficient is uniform in −1 … 1.
inline LightCoefficients random_light(int bands, uint64_t seed) {
    RandomStream random(seed);
    LightCoefficients light{bands, {}};
    const auto number = [&] { return static_cast<float>(2.0 * random.uniform() - 1.0); };
    for (int i = 0; i < bands * bands; ++i) {
        const float red = number(), green = number(), blue = number();
        light.values.emplace_back(red, green, blue);
    }
    return light;
}

}  // namespace paim
