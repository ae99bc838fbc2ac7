// Unpacks residuals of a plane from symbols and escapes (packed_plane.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "paim/format/pack/packed_plane.h"

namespace paim {

// Values in a tile. The packed bits of a tile start at a whole byte, whatever the magnitude.
constexpr size_t kTileValues = 240;
// Number of values that unpack_symbols() may write after the requested ones.
constexpr size_t kTilePadding = 8;

// out[j] = symbol first + j, for j in [0, count). Up to kTilePadding values after them are
// overwritten.
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

    // Adds all escapes before value `end` that have not been added yet.
    // at(place)  returns a reference to the value number `place`, an unsigned integer
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
        // Local copies: the compiler must assume that writing through at() changes the members.
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
