// ScaledFactors as floats, as the paper stores them.
#pragma once

#include <cstdint>

#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/codec/asset.h"

namespace paim {

// The first components in f32, or rounded to f16; each with unit RMS, its weights scaled
// accordingly.
LowRank float_matrix(const ScaledFactors& factors, uint32_t num_components, Precision precision);

}  // namespace paim
