// ScaledFactors as floats, as the paper stores them.
#pragma once

#include <cstdint>

#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/codec/model.h"

namespace paim {

// The first components in f32, or rounded to f16; each with unit RMS, its weights scaled accordingly.
LowRankMatrix float_part(const ScaledFactors& factors, uint32_t num_components,
                         Precision precision);

}  // namespace paim
