// The glossy transfer of a vertex that nothing occludes, in closed form up to a quadrature.
#pragma once

#include <vector>

#include "compressor/material/exit_functions.h"

namespace paim {

// ∫ b_o(s) y_i(s) ds over the upper hemisphere, in the frame of the surface. The functions are those
// of the table, as evaluate() computes them, so that rays converge to exactly this.
// in_bands  1 … sh::kMaxBands
// returns   [K][in_bands²], rows as ExitFunctions::coefficients()
// err       1e-9 relative to the largest value, up to 10 bands of light
std::vector<double> open_gloss(const ExitFunctions& functions, int in_bands);

}  // namespace paim
