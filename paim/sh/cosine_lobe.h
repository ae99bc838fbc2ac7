// The clamped cosine lobe in spherical harmonics, in closed form.
// Based on: Ramamoorthi and Hanrahan, On the Relationship between Radiance and Irradiance, 2001
#pragma once

namespace paim::sh {

// â_l / π, where â_l = 2π ∫₀¹ P_l(z) z dz: 1, 2/3, 1/4, 0, -1/24, 0, … The transfer of an
// unoccluded vertex with normal n is t_i = cosine_lobe(l) · y_i(n) (E1,
// docs/algorithms/transfer.md). 0 <= l < kMaxBands.
double cosine_lobe(int l);

}  // namespace paim::sh
