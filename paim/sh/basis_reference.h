// The basis straight from its definition, slowly, in long double. The fast evaluations are tested
// against it.
// Based on: Robin Green, Spherical Harmonic Lighting: The Gritty Details, 2003 (without the phase
//           (−1)^m)
#pragma once

#include "paim/base/vector.h"

namespace paim::sh {

// y_lm(direction); direction unit, 0 <= l < kMaxBands, |m| <= l.
double basis_reference(int l, int m, const Vec3d& direction);

}  // namespace paim::sh
