// The error of dropping components, from singular values alone.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <cstddef>
#include <span>

#include "paim/codec/rebuild_planes.h"

namespace paim {

// E5, the paper's theoretical error of keeping K components: Σ_{k≥K} s_k / Σ_k s_k, 0 … 1. 0 where
// all singular values are 0.
double theory_error(std::span<const double> singular_values, size_t num_components);

// The energy error √(Σ_{k≥K} s_k² / Σ_k s_k²), 0 … 1. It equals the relative Frobenius error of the
// centred matrix.
double energy_error(std::span<const double> singular_values, size_t num_components);

// The same for the components that a matrix has, which need not be the first ones.
double theory_error(const LowRank& matrix);
double energy_error(const LowRank& matrix);

}  // namespace paim
