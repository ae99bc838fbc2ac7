// Unpacks residuals of a plane from symbols and escapes.
#include "paim/format/pack/plane_unpacking.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "paim/base/check.h"

namespace paim {

namespace {

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

template void unpack_symbols(uint8_t, const uint8_t*, size_t, size_t, int8_t*);
template void unpack_symbols(uint8_t, const uint8_t*, size_t, size_t, int16_t*);

}  // namespace paim
