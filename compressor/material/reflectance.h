// How much of the light that arrives a BRDF reflects.
#pragma once

#include "compressor/material/brdf.h"

namespace paim {

// The share of the light along the normal that is reflected: ∫ value(n, v) cos θ_v dv, at least 0.
// err  1e-6 relative
double normal_reflectance(const Brdf& brdf);

}  // namespace paim
