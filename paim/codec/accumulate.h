// Sums of weighted components, which take most of the time of decoding a frame. They use the vector
// unit of the machine. All units give the same bytes, because the order of operations is fixed and
// additions are not fused with multiplications.
#pragma once

#include <cstddef>
#include <span>

#include "paim/codec/stored_values.h"
#include "paim/codec/vector_unit.h"

namespace paim {

// out[n] = step · (… ((mean[first + n] + weights[0] · components[0][first + n]) + weights[1] · …)).
// components and weights have one size (checked), values [first, first + out.size()) exist
// (checked).
void accumulate(const StoredValues& mean, std::span<const StoredValues> components,
                std::span<const float> weights, float step, size_t first, std::span<float> out,
                VectorUnit unit = best_vector_unit());

}  // namespace paim
