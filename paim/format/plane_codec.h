// Planes of small integers as bytes: predicted from neighbours, packed, then Zstandard.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/stored_values.h"
#include "paim/format/plane_predictor.h"
#include "paim/format/scratch_pool.h"
#include "paim/format/zstd_codec.h"

namespace paim {

// values     [planes][N], integers
// predictor  of N points, or without a mesh
// Every plane is predicted and packed in the way that seems smallest. The same bytes for the same
// input on any number of threads.
std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort = Effort::small);

// Fills out [planes][N]; false for bytes that are not such planes, or whose values do not fit.
// bytes  the stored section; whatever they are, memory grows with out.size() alone
// pool   to work in, shared by whoever decodes at the same time
template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, ScratchPool& pool, std::span<Integer> out);

template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, std::span<Integer> out) {
    ScratchPool pool;
    return decode_planes(bytes, num_planes, predictor, pool, out);
}

}  // namespace paim
