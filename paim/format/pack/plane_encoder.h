// Encodes planes of small integers: prediction from neighbours, packing, then Zstandard.
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
// returns    one Zstandard frame
// Each plane has the prediction and the packing with the smallest estimated size. The same input
// gives the same bytes on any number of threads.
std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort = Effort::small);

// Memory of encode_planes() for integers of num_bytes: the bytes of each way to predict and pack
// them, and their compression.
constexpr uint64_t encode_planes_scratch_bytes(uint64_t num_bytes) {
    return 8 * num_bytes + zstd_compress_scratch_bytes(num_bytes);
}

}  // namespace paim
