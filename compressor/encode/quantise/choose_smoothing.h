// How often each plane of quantised positions is smoothed when it is read.
#pragma once

#include "compressor/encode/quantise/quantise.h"
#include "paim/mesh/topology.h"

namespace paim {

// Chooses for each plane of the mean and of each component the number of rounds that leaves the
// smallest squared error (codec/surface_smoothing.h), and smooths the matrix. Leaves it as it is if
// no plane gains, or if its integers leave no room for fraction bits.
// matrix  quantise(factors, …)
void smooth_quantised(const ScaledFactors& factors, const Topology& topology, LowRank& matrix);

// quantise(), smoothed.
LowRank smoothed(const ScaledFactors& factors, const Quantiser& quantiser,
                 const Topology& topology);

}  // namespace paim
