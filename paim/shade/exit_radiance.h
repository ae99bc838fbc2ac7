// Radiance of glossy vertices towards an eye.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer for Real-Time Rendering in
//           Dynamic, Low-Frequency Lighting Environments, 2002, section 6
#pragma once

#include <span>

#include "paim/base/vector.h"

namespace paim {

// radiance(r) = Σ_o exit(o, r) · y_o(direction(r)), per channel. Deterministic on any number of
// threads.
// out_bands   1 … sh::kMaxBands
// exit        [out_bands²][R] outgoing coefficients, linear RGB
// directions  [R] unit, from the surface towards the eye, in the axes of the coefficients
// radiance    [R]; may be slightly negative where the spherical harmonics ring
void exit_towards(int out_bands, std::span<const Vec3f> exit, std::span<const Vec3f> directions,
                  std::span<Vec3f> radiance);

}  // namespace paim
