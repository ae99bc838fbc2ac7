// Residuals of a plane as bytes, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "paim/format/plane_predictor.h"

namespace paim {

// The residuals of a plane of N values:
//   nothing  all zero, no bytes
//   packed   as many base-(2a + 1) digits r + a a byte as fit, the first one the highest
//   bytes    one a value, zigzag (0, −1, 1, −2, …)
//   words    two a value, zigzag: all low bytes, then all high bytes
enum class Packing : uint8_t { nothing = 0, packed = 1, bytes = 2, words = 3 };

constexpr int32_t kMaxPackedMagnitude = 7;  // 15² < 256: at least two values a byte

// Two bytes a plane in a file: what is predicted and how it is packed; the largest magnitude a, of
// Packing::packed alone.
struct PlaneHeader {
    Prediction prediction = Prediction::none;
    Packing packing = Packing::nothing;
    uint8_t magnitude = 0;
};

// Bytes of `count` values.
size_t packed_size(const PlaneHeader& header, size_t count);

// out  [packed_size()]
void pack(const PlaneHeader& header, std::span<const int32_t> residuals, uint8_t* out);

// A tile is a number of values that starts at a byte in every packing.
constexpr size_t kTileValues = 240;
// What unpack_tile() may write past the values it was asked for.
constexpr size_t kTilePadding = 8;

// out[j] = residual first + j, for j in [0, count); after them, junk up to the padding.
// source  [packed_size(header, num_values)] bytes of the whole plane, any bytes
// first   a multiple of kTileValues
// count   up to kTileValues
// out     [count + kTilePadding]
void unpack_tile(const PlaneHeader& header, const uint8_t* source, size_t num_values, size_t first,
                 size_t count, int16_t* out);

}  // namespace paim
