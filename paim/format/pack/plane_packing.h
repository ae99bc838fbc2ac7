// Residuals of a plane as bytes, and back.
// Based on: Nystad, Lassen, Pomianowski, Ellis and Olson, Adaptive Scalable Texture Compression,
//           2012 (its bounded integer sequence encoding, BISE: symbols of base 3 or 5 share bytes);
//           Zukowski, Héman, Nes and Boncz, Super-Scalar RAM-CPU Cache Compression, 2006 (PFOR:
//           few bits for most values, and a list of patches for the others)
//
// Most residuals are zero or nearly zero. Each becomes a symbol of a small alphabet, and as many
// symbols are packed into a byte as fit. A residual outside the alphabet becomes the nearest symbol
// and an escape: how many values to pass over, and what to add there. Huffman codes of such bytes
// come near the entropy of the values, without any search for repetitions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "paim/format/pack/plane_predictor.h"

namespace paim {

// The magnitude a of a plane: its symbols are the integers −a … a. 0: the plane has no symbols.
// 1, 2, 7: 5, 3 or 2 symbols share a byte, the first one in the highest place. kByteSymbols: each
// symbol has a byte of its own, in zigzag (0, −1, 1, −2, … are 0, 1, 2, 3, …).
constexpr uint8_t kByteSymbols = 127;
constexpr std::array<uint8_t, 5> kMagnitudes{0, 1, 2, 7, kByteSymbols};

// Of a plane in a file.
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
// A negative number comes back as its two's complement.
constexpr uint32_t undo_zigzag(uint32_t code) {
    return (code >> 1) ^ (0 - (code & 1));
}

// Number of bytes that `count` symbols take.
size_t symbol_bytes(uint8_t magnitude, size_t count);

struct PackedPlane {
    PlaneHeader header;
    std::vector<uint8_t> symbols;  // [symbol_bytes()]
    // [num_escapes] each. gaps: how many values lie between an escape and the one before it. lows,
    // highs: the bytes of what the escape adds, in zigzag; highs is empty unless the header says
    // wide. Where more than 255 values lie between, escapes that add 0 fill the distance.
    std::vector<uint8_t> gaps, lows, highs;
};

// Residuals beyond ±magnitude become the symbol ±magnitude and an escape that adds the rest.
template <typename Integer>
PackedPlane pack(Prediction prediction, uint8_t magnitude, std::span<const Integer> residuals);

// Values in a tile. A tile starts at the beginning of a byte for every magnitude.
constexpr size_t kTileValues = 240;
// How many values unpack_symbols() may write past those it was asked for.
constexpr size_t kTilePadding = 8;

// out[j] = symbol first + j, for j in [0, count). Up to kTilePadding values after them are junk.
// source  [symbol_bytes(magnitude, first + count)], any bytes
// first   a multiple of kTileValues
// count   up to kTileValues
// out     [count + kTilePadding]
template <typename Integer>
void unpack_symbols(uint8_t magnitude, const uint8_t* source, size_t first, size_t count,
                    Integer* out);

// The escapes of a plane, in order. Their bytes may be anything.
class Escapes {
  public:
    Escapes() = default;
    // gaps, lows, highs  [header.num_escapes]; highs is read only if the header says wide
    Escapes(const PlaneHeader& header, const uint8_t* gaps, const uint8_t* lows,
            const uint8_t* highs)
        : gaps_(gaps), lows_(lows), highs_(highs), wide_(header.wide), end_(header.num_escapes) {
        if (end_ > 0) place_ = gaps_[0];
    }

    bool done() const { return next_ == end_; }

    // Adds every escape before value `end` that was not added yet.
    // at(place)  a reference to the value at that place, an unsigned integer
    template <typename At>
    void add_until(size_t end, const At& at) {
        if (wide_) {
            add<true>(end, at);
        } else {
            add<false>(end, at);
        }
    }

  private:
    template <bool kWide, typename At>
    void add(size_t end, const At& at) {
        // Copies, because writing through at() could change the members.
        const uint8_t* const gaps = gaps_;
        const uint8_t* const lows = lows_;
        const uint8_t* const highs = highs_;
        const size_t last = end_;
        size_t next = next_, place = place_;
        while (next < last && place < end) {
            uint32_t code = lows[next];
            if constexpr (kWide) code |= uint32_t{highs[next]} << 8;
            auto& value = at(place);
            value =
                static_cast<std::remove_reference_t<decltype(value)>>(value + undo_zigzag(code));
            if (++next < last) place += size_t{1} + gaps[next];
        }
        next_ = next;
        place_ = place;
    }

    const uint8_t* gaps_ = nullptr;
    const uint8_t* lows_ = nullptr;
    const uint8_t* highs_ = nullptr;
    bool wide_ = false;
    size_t next_ = 0, end_ = 0;
    size_t place_ = 0;  // of the next escape
};

}  // namespace paim
