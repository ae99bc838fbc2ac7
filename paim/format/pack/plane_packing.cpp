// Residuals of a plane as bytes, and back.
#include "paim/format/pack/plane_packing.h"

#include <algorithm>
#include <cstring>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr uint32_t base_of(uint32_t magnitude) {
    return 2 * magnitude + 1;
}

// Digits that fit into a byte.
constexpr uint32_t digits_per_byte(uint32_t magnitude) {
    uint32_t digits = 0;
    for (uint32_t range = base_of(magnitude); range <= 256; range *= base_of(magnitude)) ++digits;
    return digits;
}

// What each byte stands for, so many digits that one copy of a power of two of values takes them.
template <typename Integer, uint32_t kMagnitude>
struct DigitTable {
    static constexpr uint32_t kDigits = digits_per_byte(kMagnitude);
    static constexpr uint32_t kCopied = kDigits > 4 ? 8 : kDigits > 2 ? 4 : 2;
    static_assert(kTileValues % kDigits == 0 && kCopied <= kTilePadding);
    std::array<std::array<Integer, kCopied>, 256> values{};

    constexpr DigitTable() {
        for (uint32_t byte = 0; byte < 256; ++byte) {
            uint32_t rest = byte;
            for (uint32_t j = kDigits; j-- > 0; rest /= base_of(kMagnitude)) {
                values[byte][j] = static_cast<Integer>(
                    static_cast<int32_t>(rest % base_of(kMagnitude)) - int32_t{kMagnitude});
            }
        }
    }
};

template <typename Integer, uint32_t kMagnitude>
constexpr DigitTable<Integer, kMagnitude> kDigitTable;

template <typename Integer, uint32_t kMagnitude>
void unpack(const uint8_t* source, size_t first, size_t count, Integer* out) {
    constexpr const auto& kTable = kDigitTable<Integer, kMagnitude>;
    source += first / kTable.kDigits;
    for (size_t j = 0; j < count; j += kTable.kDigits) {
        std::memcpy(out + j, kTable.values[*source++].data(), kTable.kCopied * sizeof(Integer));
    }
}

}  // namespace

size_t digit_bytes(uint8_t magnitude, size_t count) {
    if (magnitude == 0) return 0;
    if (magnitude == kByteDigits) return count;
    const uint32_t digits = digits_per_byte(magnitude);
    return (count + digits - 1) / digits;
}

template <typename Integer>
PackedPlane pack(Prediction prediction, uint8_t magnitude, std::span<const Integer> residuals) {
    PackedPlane plane{{prediction, false, magnitude, 0}, {}, {}, {}, {}};
    const auto most = int32_t{magnitude};
    const uint32_t per_byte =
        magnitude == 0 || magnitude == kByteDigits ? 1 : digits_per_byte(magnitude);
    plane.digits.reserve(digit_bytes(magnitude, residuals.size()));
    uint32_t byte = 0, num_digits = 0;
    size_t gap = 0;
    const auto add_exception = [&](size_t passed_over, uint32_t code) {
        plane.gaps.push_back(static_cast<uint8_t>(passed_over));
        plane.lows.push_back(static_cast<uint8_t>(code));
        plane.highs.push_back(static_cast<uint8_t>(code >> 8));
        plane.header.wide = plane.header.wide || (code >> 8) != 0;
    };
    for (size_t n = 0; n < residuals.size(); ++n, ++gap) {
        const int32_t digit = std::clamp<int32_t>(residuals[n], -most, most);
        if (digit != residuals[n]) {
            for (; gap > 255; gap -= 256) add_exception(255, 0);
            add_exception(gap, zigzag(residuals[n] - digit));
            gap = static_cast<size_t>(-1);
        }
        if (magnitude == kByteDigits) {
            plane.digits.push_back(static_cast<uint8_t>(zigzag(digit)));
        } else if (magnitude != 0) {
            byte = byte * base_of(magnitude) + static_cast<uint32_t>(digit + most);
            if (++num_digits == per_byte) {
                plane.digits.push_back(static_cast<uint8_t>(byte));
                byte = num_digits = 0;
            }
        }
    }
    if (num_digits > 0) {
        for (; num_digits < per_byte; ++num_digits) byte = byte * base_of(magnitude) + magnitude;
        plane.digits.push_back(static_cast<uint8_t>(byte));
    }
    if (!plane.header.wide) plane.highs.clear();
    plane.header.num_exceptions = static_cast<uint32_t>(plane.gaps.size());
    return plane;
}

template <typename Integer>
void unpack_digits(uint8_t magnitude, const uint8_t* source, size_t first, size_t count,
                   Integer* out) {
    switch (magnitude) {
        case 1:
            return unpack<Integer, 1>(source, first, count, out);
        case 2:
            return unpack<Integer, 2>(source, first, count, out);
        case 7:
            return unpack<Integer, 7>(source, first, count, out);
        case kByteDigits:
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
template void unpack_digits(uint8_t, const uint8_t*, size_t, size_t, int8_t*);
template void unpack_digits(uint8_t, const uint8_t*, size_t, size_t, int16_t*);

}  // namespace paim
