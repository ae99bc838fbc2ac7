// The radiance that spherical-harmonic coefficients stand for.
#pragma once

#include <span>
#include <vector>

#include "paim/light/light.h"

namespace paim::player {

// Radiance from each direction, Σ_i L_i y_i(ω): the light itself, but for what its bands leave out.
// Where they ring, it is negative.
// directions  unit
// radiance    [directions]
// err         that of sh::BatchBasis, for each coefficient
void reconstruct_light(const LightCoefficients& light, std::span<const Vec3f> directions,
                       std::span<Vec3f> radiance);

// Share of all directions from which a channel of the light is negative, 0 … 1, to about a thousandth.
double negative_share(const LightCoefficients& light);

// Unit directions that stand for equal parts of the sphere.
// Based on: González, Measurement of Areas on a Sphere Using Fibonacci and Latitude–Longitude
//           Lattices, 2010 (with half steps at the ends instead of an odd number of points)
std::vector<Vec3f> equal_area_directions(int count);

}  // namespace paim::player
