// Residuals of a plane as bytes, and back.
// Based on: Nystad et al. 2012 (BISE); Zukowski et al. 2006 (PFOR) (see the header)
#include "paim/format/pack/plane_packing.h"

#include <algorithm>
#include <cstring>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr uint32_t base_of(uint32_t magnitude) {
    return 2 * magnitude + 1;
}

// How many symbols fit into a byte.
constexpr uint32_t symbols_per_byte(uint32_t magnitude) {
    uint32_t symbols = 0;
    for (uint32_t range = base_of(magnitude); range <= 256; range *= base_of(magnitude)) ++symbols;
    return symbols;
}

// The symbols of each byte, padded to a power of two so that one copy writes all of them.
template <typename Integer, uint32_t kMagnitude>
struct SymbolTable {
    static constexpr uint32_t kSymbols = symbols_per_byte(kMagnitude);
    static constexpr uint32_t kCopied = kSymbols > 4 ? 8 : kSymbols > 2 ? 4 : 2;
    static_assert(kTileValues % kSymbols == 0 && kCopied <= kTilePadding);
    std::array<std::array<Integer, kCopied>, 256> values{};

    constexpr SymbolTable() {
        for (uint32_t byte = 0; byte < 256; ++byte) {
            uint32_t rest = byte;
            for (uint32_t j = kSymbols; j-- > 0; rest /= base_of(kMagnitude)) {
                values[byte][j] = static_cast<Integer>(
                    static_cast<int32_t>(rest % base_of(kMagnitude)) - int32_t{kMagnitude});
            }
        }
    }
};

template <typename Integer, uint32_t kMagnitude>
constexpr SymbolTable<Integer, kMagnitude> kSymbolTable;

template <typename Integer, uint32_t kMagnitude>
void unpack(const uint8_t* source, size_t first, size_t count, Integer* out) {
    constexpr const auto& kTable = kSymbolTable<Integer, kMagnitude>;
    source += first / kTable.kSymbols;
    for (size_t j = 0; j < count; j += kTable.kSymbols) {
        std::memcpy(out + j, kTable.values[*source++].data(), kTable.kCopied * sizeof(Integer));
    }
}

}  // namespace

size_t symbol_bytes(uint8_t magnitude, size_t count) {
    if (magnitude == 0) return 0;
    if (magnitude == kByteSymbols) return count;
    const uint32_t symbols = symbols_per_byte(magnitude);
    return (count + symbols - 1) / symbols;
}

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

template <typename Integer>
void unpack_symbols(uint8_t magnitude, const uint8_t* source, size_t first, size_t count,
                    Integer* out) {
    switch (magnitude) {
        case 1:
            return unpack<Integer, 1>(source, first, count, out);
        case 2:
            return unpack<Integer, 2>(source, first, count, out);
        case 7:
            return unpack<Integer, 7>(source, first, count, out);
        case kByteSymbols:
            for (size_t j = 0; j < count; ++j) {
                const uint8_t code = source[first + j];
                out[j] = static_cast<int8_t>(undo_zigzag(code));
            }
            return;
        default:
            PAIM_CHECK_EQ(int{magnitude}, 0);
            std::fill_n(out, count, Integer{0});
    }
}

template PackedPlane pack(Prediction, uint8_t, std::span<const int8_t>);
template PackedPlane pack(Prediction, uint8_t, std::span<const int16_t>);
template void unpack_symbols(uint8_t, const uint8_t*, size_t, size_t, int8_t*);
template void unpack_symbols(uint8_t, const uint8_t*, size_t, size_t, int16_t*);

}  // namespace paim
