// Planes of small integers as bytes: predicted from neighbours, packed, then Zstandard.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/stored_values.h"
#include "paim/format/pack/plane_predictor.h"
#include "paim/format/pack/workspace.h"
#include "paim/format/pack/zstd_codec.h"

namespace paim {

// values     [planes][N], integers
// predictor  of N points, or without a mesh
// Each plane gets the prediction and the packing that are estimated to be the smallest. The same
// input gives the same bytes on any number of threads.
std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort = Effort::small);

// Memory of encode_planes() for integers of so many bytes: what the ways to predict and pack them
// make, as bytes, and their compression.
constexpr uint64_t encode_planes_scratch_bytes(uint64_t num_bytes) {
    return 8 * num_bytes + zstd_compress_scratch_bytes(num_bytes);
}

// Planes in a file, and where they go.
template <typename Integer>
struct StoredPlanes {
    std::span<const uint8_t> bytes;  // the stored section; may be anything
    size_t num_planes = 0;           // at least 1
    std::span<Integer> out;          // [planes][N]
};

// Fills every `out`. False for bytes that are not such planes, and for values outside the symmetric
// range of the integers. Planes are reconstructed side by side; kPlanesAtOnce of them is fastest.
// Memory grows with the sizes of `out` alone.
template <typename Integer>
bool decode_planes(std::span<const StoredPlanes<Integer>> sections, const PlanePredictor& predictor,
                   Workspace& workspace);

template <typename Integer>
constexpr size_t kPlanesAtOnce = 64 / sizeof(Integer);

// One section.
template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, std::span<Integer> out) {
    Workspace workspace;
    const StoredPlanes<Integer> planes{bytes, num_planes, out};
    return decode_planes(std::span(&planes, 1), predictor, workspace);
}

}  // namespace paim
