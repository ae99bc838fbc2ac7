// Residuals of a plane as bytes, and back.
//
// Most residuals are zero or nearly so: as many digits share a byte as fit, and what no digit holds is
// an exception, a number of values to pass over and one to add. Huffman codes of such bytes come near
// the entropy of the values, without any search for repetitions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "paim/format/pack/plane_predictor.h"

namespace paim {

// The largest digits a plane may have: none, digits of −a … a with the first one the highest, so many a
// byte as fit, or (kByteDigits) one a byte, zigzag (0, −1, 1, −2, …).
constexpr uint8_t kByteDigits = 127;
constexpr std::array<uint8_t, 5> kMagnitudes{0, 1, 2, 7, kByteDigits};

// Of a plane in a file.
struct PlaneHeader {
    Prediction prediction = Prediction::none;
    bool wide = false;      // whether exceptions have high bytes too
    uint8_t magnitude = 0;  // one of kMagnitudes
    uint32_t num_exceptions = 0;
};

// 0, −1, 1, −2, … as 0, 1, 2, 3, …
constexpr uint32_t zigzag(int32_t value) {
    return (static_cast<uint32_t>(value) << 1) ^ static_cast<uint32_t>(value >> 31);
}
constexpr uint32_t undo_zigzag(uint32_t code) {  // of a negative number, 2³² more
    return (code >> 1) ^ (0 - (code & 1));
}

// Bytes of so many digits.
size_t digit_bytes(uint8_t magnitude, size_t count);

struct PackedPlane {
    PlaneHeader header;
    std::vector<uint8_t> digits;  // [digit_bytes()]
    // [num_exceptions] each: the values to pass over from the last exception on, to the next; what is
    // added there, zigzag. 255 that are passed over may be followed by an exception of 0.
    std::vector<uint8_t> gaps, lows, highs;  // highs only of wide ones
};

// Digits end at ±magnitude, and exceptions have the rest.
template <typename Integer>
PackedPlane pack(Prediction prediction, uint8_t magnitude, std::span<const Integer> residuals);

// A tile is a number of values that starts at a byte, however many digits share it.
constexpr size_t kTileValues = 240;
// What unpack_digits() may write past the values it was asked for.
constexpr size_t kTilePadding = 8;

// out[j] = digit first + j, for j in [0, count); after them, junk up to the padding.
// source  [digit_bytes(magnitude, first + count)] any bytes
// first   a multiple of kTileValues
// count   up to kTileValues
// out     [count + kTilePadding]
template <typename Integer>
void unpack_digits(uint8_t magnitude, const uint8_t* source, size_t first, size_t count,
                   Integer* out);

// The exceptions of a plane, whatever their bytes, in order.
class Exceptions {
  public:
    Exceptions() = default;
    // gaps, lows, highs  [header.num_exceptions]; highs only of wide ones
    Exceptions(const PlaneHeader& header, const uint8_t* gaps, const uint8_t* lows,
               const uint8_t* highs)
        : gaps_(gaps), lows_(lows), highs_(highs), wide_(header.wide), end_(header.num_exceptions) {
        if (end_ > 0) place_ = gaps_[0];
    }

    bool done() const { return next_ == end_; }

    // Adds those before value `end` that have not been added.
    // at(place)  a reference to what one is added to: an integer without sign
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
        // Copies, as what is written may be anything.
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
    size_t place_ = 0;  // of the next one
};

}  // namespace paim
