// What a quantised matrix costs in a file.
#pragma once

#include <cstdint>

#include "paim/codec/model.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/pack/zstd_encoder.h"

namespace paim {

// Bytes of its mean, components and weights as they will be stored, with their table entries. Fast
// effort gives some percent more than what the file will have: good for comparing.
uint64_t stored_bytes(const LowRankMatrix& matrix, const PlanePredictor& predictor, Effort effort);

}  // namespace paim
