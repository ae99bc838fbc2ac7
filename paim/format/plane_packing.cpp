// Residuals of a plane as bytes, and back.
#include "paim/format/plane_packing.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace paim {

namespace {

constexpr uint32_t zigzag(int32_t value) {
    return (static_cast<uint32_t>(value) << 1) ^ static_cast<uint32_t>(value >> 31);
}

// Of 16 bits at most.
constexpr int16_t unzigzag(uint16_t code) {
    return static_cast<int16_t>((code >> 1) ^ (0 - (code & 1)));
}

// Digits of a base that fit into a byte.
constexpr uint32_t digits_per_byte(uint32_t base) {
    uint32_t digits = 0;
    for (uint32_t range = base; range <= 256; range *= base) ++digits;
    return digits;
}

constexpr uint32_t base_of(uint32_t magnitude) {
    return 2 * magnitude + 1;
}

// What each byte stands for, so many digits that one copy of a power of two of bytes takes them.
template <uint32_t kMagnitude>
struct DigitTable {
    static constexpr uint32_t kDigits = digits_per_byte(base_of(kMagnitude));
    static constexpr uint32_t kCopied = kDigits > 4 ? 8 : kDigits > 2 ? 4 : 2;
    static_assert(kTileValues % kDigits == 0 && kCopied <= kTilePadding);
    std::array<std::array<int16_t, kCopied>, 256> values{};

    constexpr DigitTable() {
        for (uint32_t byte = 0; byte < 256; ++byte) {
            uint32_t rest = byte;
            for (uint32_t j = kDigits; j-- > 0; rest /= base_of(kMagnitude)) {
                values[byte][j] = static_cast<int16_t>(
                    static_cast<int32_t>(rest % base_of(kMagnitude)) - int32_t{kMagnitude});
            }
        }
    }
};

template <uint32_t kMagnitude>
constexpr DigitTable<kMagnitude> kDigitTable;

template <uint32_t kMagnitude>
void unpack_digits(const uint8_t* source, size_t first, size_t count, int16_t* out) {
    constexpr const auto& kTable = kDigitTable<kMagnitude>;
    source += first / kTable.kDigits;
    for (size_t j = 0; j < count; j += kTable.kDigits) {
        std::memcpy(out + j, kTable.values[*source++].data(), kTable.kCopied * sizeof(int16_t));
    }
}

void pack_digits(std::span<const int32_t> residuals, uint8_t magnitude, uint8_t* out) {
    const uint32_t base = base_of(magnitude);
    const uint32_t digits = digits_per_byte(base);
    for (size_t first = 0; first < residuals.size(); first += digits) {
        uint32_t byte = 0;
        for (size_t j = first; j < first + digits; ++j) {
            const int32_t residual = j < residuals.size() ? residuals[j] : 0;
            byte = byte * base + static_cast<uint32_t>(residual + magnitude);
        }
        *out++ = static_cast<uint8_t>(byte);
    }
}

}  // namespace

size_t packed_size(const PlaneHeader& header, size_t count) {
    switch (header.packing) {
        case Packing::nothing:
            return 0;
        case Packing::packed: {
            const uint32_t digits = digits_per_byte(base_of(header.magnitude));
            return (count + digits - 1) / digits;
        }
        case Packing::bytes:
            return count;
        case Packing::words:
            return 2 * count;
    }
    return 0;
}

void pack(const PlaneHeader& header, std::span<const int32_t> residuals, uint8_t* out) {
    switch (header.packing) {
        case Packing::nothing:
            return;
        case Packing::packed:
            return pack_digits(residuals, header.magnitude, out);
        case Packing::bytes:
            for (const int32_t r : residuals) *out++ = static_cast<uint8_t>(zigzag(r));
            return;
        case Packing::words:
            for (size_t j = 0; j < residuals.size(); ++j) {
                const uint32_t code = zigzag(residuals[j]);
                out[j] = static_cast<uint8_t>(code);
                out[residuals.size() + j] = static_cast<uint8_t>(code >> 8);
            }
            return;
    }
}

void unpack_tile(const PlaneHeader& header, const uint8_t* source, size_t num_values, size_t first,
                 size_t count, int16_t* __restrict out) {
    using UnpackDigits = void (*)(const uint8_t*, size_t, size_t, int16_t*);
    static constexpr UnpackDigits kUnpackDigits[kMaxPackedMagnitude] = {
        unpack_digits<1>, unpack_digits<2>, unpack_digits<3>, unpack_digits<4>,
        unpack_digits<5>, unpack_digits<6>, unpack_digits<7>};
    switch (header.packing) {
        case Packing::nothing:
            std::fill_n(out, count, int16_t{0});
            return;
        case Packing::packed:
            return kUnpackDigits[header.magnitude - 1](source, first, count, out);
        case Packing::bytes:
            for (size_t j = 0; j < count; ++j) out[j] = unzigzag(source[first + j]);
            return;
        case Packing::words: {
            const uint8_t* low = source + first;
            const uint8_t* high = low + num_values;
            for (size_t j = 0; j < count; ++j) {
                out[j] = unzigzag(static_cast<uint16_t>(low[j] | (high[j] << 8)));
            }
            return;
        }
    }
}

}  // namespace paim
