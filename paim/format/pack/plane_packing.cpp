// Packs residuals of a plane as symbols and escapes.
#include "paim/format/pack/plane_packing.h"

#include <algorithm>

namespace paim {

template <typename Integer>
PackedPlane pack(Prediction prediction, uint8_t magnitude, std::span<const Integer> residuals) {
    PackedPlane plane{{prediction, false, magnitude, 0}, {}, {}, {}, {}};
    const auto most = int32_t{magnitude};
    const uint32_t per_byte =
        magnitude == 0 || magnitude == kByteSymbols ? 1 : symbols_per_byte(magnitude);
    plane.symbols.reserve(symbol_bytes(magnitude, residuals.size()));
    uint32_t byte = 0, num_symbols = 0;
    size_t gap = 0;
    const auto add_escape = [&](size_t passed_over, uint32_t code) {
        plane.gaps.push_back(static_cast<uint8_t>(passed_over));
        plane.lows.push_back(static_cast<uint8_t>(code));
        plane.highs.push_back(static_cast<uint8_t>(code >> 8));
        plane.header.wide = plane.header.wide || (code >> 8) != 0;
    };
    for (size_t n = 0; n < residuals.size(); ++n, ++gap) {
        const int32_t symbol = std::clamp<int32_t>(residuals[n], -most, most);
        if (symbol != residuals[n]) {
            for (; gap > 255; gap -= 256) add_escape(255, 0);
            add_escape(gap, zigzag(residuals[n] - symbol));
            gap = static_cast<size_t>(-1);
        }
        if (magnitude == kByteSymbols) {
            plane.symbols.push_back(static_cast<uint8_t>(zigzag(symbol)));
        } else if (magnitude != 0) {
            byte = byte * base_of(magnitude) + static_cast<uint32_t>(symbol + most);
            if (++num_symbols == per_byte) {
                plane.symbols.push_back(static_cast<uint8_t>(byte));
                byte = num_symbols = 0;
            }
        }
    }
    if (num_symbols > 0) {
        for (; num_symbols < per_byte; ++num_symbols) byte = byte * base_of(magnitude) + magnitude;
        plane.symbols.push_back(static_cast<uint8_t>(byte));
    }
    if (!plane.header.wide) plane.highs.clear();
    plane.header.num_escapes = static_cast<uint32_t>(plane.gaps.size());
    return plane;
}

template PackedPlane pack(Prediction, uint8_t, std::span<const int8_t>);
template PackedPlane pack(Prediction, uint8_t, std::span<const int16_t>);

}  // namespace paim
