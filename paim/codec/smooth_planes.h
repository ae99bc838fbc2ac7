// Smooths many planes of integers at once, as they are when a file is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "paim/codec/stored_values.h"
#include "paim/codec/surface_smoothing.h"
#include "paim/codec/vector_unit.h"

namespace paim {

struct PlaneToSmooth {
    const StoredValues* stored;  // integers
    size_t first;                // the plane's first value
    uint32_t rounds;
    int16_t* out;  // [V]
};

// Every `out` becomes its plane after SurfaceSmoother::smooth(), as multiples of 2^-fraction_bits,
// ties to even. Takes 128 bytes a vertex. All units give the same bytes.
void smooth_planes(const SurfaceSmoother& smoother, std::span<const PlaneToSmooth> planes,
                   uint32_t fraction_bits, VectorUnit unit = best_vector_unit());

}  // namespace paim
