// The format of a packed plane: a header, symbols and escapes.
// Based on: Nystad, Lassen, Pomianowski, Ellis and Olson, Adaptive Scalable Texture Compression,
//           2012 (its bounded integer sequence encoding, BISE: symbols of base 3 or 5 share bytes);
//           Zukowski, Héman, Nes and Boncz, Super-Scalar RAM-CPU Cache Compression, 2006 (PFOR:
//           few bits for most values, and a list of patches for the others)
//
// Most residuals are zero or nearly zero. Each becomes a symbol of a small alphabet, and as many
// symbols are packed into a byte as fit. A residual outside the alphabet becomes the nearest symbol
// and an escape, which says how many values to pass over, and what to add to the next one. Huffman
// codes of such bytes come near the entropy of the values, without a search for repetitions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "paim/format/pack/plane_predictor.h"

namespace paim {

// The magnitude a of a plane: its symbols are the integers −a … a. 0: the plane has no symbols.
// 1, 2, 7: 5, 3 or 2 symbols share a byte, the first one in the highest place. kByteSymbols: each
// symbol has a byte of its own, in zigzag (0, −1, 1, −2, … are 0, 1, 2, 3, …).
constexpr uint8_t kByteSymbols = 127;
constexpr std::array<uint8_t, 5> kMagnitudes{0, 1, 2, 7, kByteSymbols};

// Header of a plane in a file.
struct PlaneHeader {
    Prediction prediction = Prediction::none;
    bool wide = false;      // whether escapes have high bytes
    uint8_t magnitude = 0;  // one of kMagnitudes
    uint32_t num_escapes = 0;
};

// Maps 0, −1, 1, −2, … to 0, 1, 2, 3, …
constexpr uint32_t zigzag(int32_t value) {
    return (static_cast<uint32_t>(value) << 1) ^ static_cast<uint32_t>(value >> 31);
}
// The inverse of zigzag(). Negative numbers are returned as their two's complement.
constexpr uint32_t undo_zigzag(uint32_t code) {
    return (code >> 1) ^ (0 - (code & 1));
}

// Number of values that a symbol of the magnitude can have.
constexpr uint32_t base_of(uint32_t magnitude) {
    return 2 * magnitude + 1;
}

// Number of symbols that fit into a byte.
constexpr uint32_t symbols_per_byte(uint32_t magnitude) {
    uint32_t symbols = 0;
    for (uint32_t range = base_of(magnitude); range <= 256; range *= base_of(magnitude)) ++symbols;
    return symbols;
}

// Number of bytes that `count` symbols take.
constexpr size_t symbol_bytes(uint8_t magnitude, size_t count) {
    if (magnitude == 0) return 0;
    if (magnitude == kByteSymbols) return count;
    const uint32_t symbols = symbols_per_byte(magnitude);
    return (count + symbols - 1) / symbols;
}

// Size of a header in a file.
constexpr size_t kPlaneHeaderBytes = 6;

}  // namespace paim
