// Packs residuals of a plane as symbols and escapes (packed_plane.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/format/pack/packed_plane.h"

namespace paim {

struct PackedPlane {
    PlaneHeader header;
    std::vector<uint8_t> symbols;  // [symbol_bytes()]
    // [num_escapes] each. gaps: the number of values between an escape and the one before it;
    // longer distances than 255 are bridged by escapes that add 0. lows, highs: the low and the
    // high byte of the number that the escape adds, in zigzag; highs is empty unless the header
    // says wide.
    std::vector<uint8_t> gaps, lows, highs;
};

// Residuals beyond ±magnitude become the symbol ±magnitude and an escape that adds the rest.
template <typename Integer>
PackedPlane pack(Prediction prediction, uint8_t magnitude, std::span<const Integer> residuals);

}  // namespace paim
