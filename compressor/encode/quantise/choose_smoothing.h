// How often each plane of quantised positions is smoothed when it is read.
#pragma once

#include "compressor/encode/quantise/quantise.h"
#include "paim/codec/surface_smoothing.h"

namespace paim {

// Chooses for each plane of the mean and of each component the number of rounds that leaves the
// smallest squared error (codec/surface_smoothing.h), and smooths the matrix. Leaves it as it is if
// no plane gains, or if its integers leave no room for fraction bits.
// smoother  of the mesh whose vertices are the points
// matrix    quantise(factors, …)
void smooth_quantised(const ScaledFactors& factors, const SurfaceSmoother& smoother,
                      LowRank& matrix);

// quantise(), smoothed.
LowRank smoothed(const ScaledFactors& factors, const Quantiser& quantiser,
                 const SurfaceSmoother& smoother);

}  // namespace paim
