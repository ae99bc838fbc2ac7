// Phong's reflection, normalised so that it neither makes energy nor breaks reciprocity.
// Based on: Lafortune and Willems, Using the Modified Phong Reflectance Model for Physically Based
//           Rendering, 1994
#pragma once

#include "compressor/material/brdfs.h"

namespace paim {

// "phong": f = ks (n + 2) / 2π · max(0, cos α)^n, where α is the angle between the direction of view
// and the mirror image of the direction of light. ks, 0 … 1, is the share of the light along the
// normal that it reflects; from elsewhere it reflects less. n is 1 … 10,000.
BrdfType phong();

}  // namespace paim
