// Planes of small integers as bytes: predicted from neighbours, packed, then Zstandard.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "paim/codec/stored_values.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/pack/zstd_encoder.h"

namespace paim {

// values     [planes][N], integers
// predictor  of N points, or without a mesh
// Each plane gets the prediction and the packing that are estimated to be the smallest. The same
// input gives the same bytes on any number of threads.
std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort = Effort::small);

}  // namespace paim
