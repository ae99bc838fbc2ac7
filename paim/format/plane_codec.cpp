// Planes of small integers as bytes.
//
// The contents of the frame: two bytes a plane (what is predicted and how it is packed; the largest
// magnitude a, if it is less than 256), then the planes' residuals one after the other:
//   nothing  all zero
//   packed   as many base-(2a + 1) digits r + a a byte as fit, the first one the highest
//   bytes    one a value, zigzag (0, −1, 1, −2, …)
//   words    two a value, zigzag: all low bytes, then all high bytes
#include "paim/format/plane_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

enum class Packing : uint8_t { nothing = 0, packed = 1, bytes = 2, words = 3 };

constexpr int32_t kMaxPackedMagnitude = 7;  // 15² < 256: at least two values a byte
constexpr size_t kHeaderBytes = 2;

struct PlaneHeader {
    Prediction prediction = Prediction::none;
    Packing packing = Packing::nothing;
    uint8_t magnitude = 0;
};

uint32_t zigzag(int32_t value) {
    return (static_cast<uint32_t>(value) << 1) ^ static_cast<uint32_t>(value >> 31);
}

int32_t unzigzag(uint32_t code) {
    return static_cast<int32_t>((code >> 1) ^ (0u - (code & 1u)));
}

// Digits of a base that fit into a byte.
uint32_t digits_per_byte(uint32_t base) {
    uint32_t digits = 0;
    for (uint32_t range = base; range <= 256; range *= base) ++digits;
    return digits;
}

// Bytes of `count` values.
size_t packed_size(const PlaneHeader& header, size_t count) {
    switch (header.packing) {
        case Packing::nothing:
            return 0;
        case Packing::packed: {
            const uint32_t digits = digits_per_byte(2u * header.magnitude + 1u);
            return (count + digits - 1) / digits;
        }
        case Packing::bytes:
            return count;
        case Packing::words:
            return 2 * count;
    }
    return 0;
}

void pack_digits(std::span<const int32_t> residuals, uint8_t magnitude, uint8_t* out) {
    const uint32_t base = 2u * magnitude + 1u;
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

// False if the bytes are none that pack() makes. residuals [N], [source] of packed_size() bytes
bool unpack(const PlaneHeader& header, const uint8_t* source, std::span<int32_t> residuals) {
    const size_t count = residuals.size();
    switch (header.packing) {
        case Packing::nothing:
            std::fill(residuals.begin(), residuals.end(), 0);
            return true;
        case Packing::packed: {
            const uint32_t base = 2u * header.magnitude + 1u;
            const uint32_t digits = digits_per_byte(base);
            // What each byte stands for.
            std::array<std::array<int8_t, 8>, 256> table{};
            for (uint32_t byte = 0; byte < 256; ++byte) {
                uint32_t rest = byte;
                for (uint32_t j = digits; j-- > 0; rest /= base) {
                    table[byte][j] = static_cast<int8_t>(static_cast<int32_t>(rest % base) -
                                                         static_cast<int32_t>(header.magnitude));
                }
            }
            for (size_t first = 0; first < count; first += digits) {
                const auto& values = table[*source++];
                const size_t end = std::min(count, first + digits);
                for (size_t j = first; j < end; ++j) residuals[j] = values[j - first];
            }
            return true;
        }
        case Packing::bytes:
            for (size_t j = 0; j < count; ++j) residuals[j] = unzigzag(source[j]);
            return true;
        case Packing::words:
            for (size_t j = 0; j < count; ++j) {
                residuals[j] = unzigzag(source[j] | (uint32_t{source[count + j]} << 8));
            }
            return true;
    }
    return false;
}

// About how many bits an entropy coder without memory makes of these bytes, its table included.
double cost_bits(std::span<const uint8_t> bytes) {
    std::array<uint32_t, 256> counts{};
    for (const uint8_t byte : bytes) ++counts[byte];
    const auto total = static_cast<double>(bytes.size());
    constexpr double kTableBits = 5.0;  // a symbol
    double bits = 0.0;
    for (const uint32_t count : counts) {
        if (count > 0) bits += kTableBits - count * std::log2(count / total);
    }
    // Huffman codes have at least one bit a symbol where there are two of them.
    return counts[bytes.empty() ? 0 : bytes[0]] == bytes.size() ? 16.0 : std::max(bits, total);
}

// A plane as bytes, and what that is expected to cost.
struct Candidate {
    PlaneHeader header;
    std::vector<uint8_t> bytes;
    double cost = std::numeric_limits<double>::infinity();
};

void consider(Candidate& best, PlaneHeader header, std::span<const int32_t> residuals) {
    std::vector<uint8_t> bytes(packed_size(header, residuals.size()));
    pack(header, residuals, bytes.data());
    const size_t half = header.packing == Packing::words ? bytes.size() / 2 : bytes.size();
    const std::span<const uint8_t> all(bytes);
    const double cost = header.packing == Packing::nothing
                            ? 0.0
                            : cost_bits(all.first(half)) +
                                  (half < bytes.size() ? cost_bits(all.subspan(half)) : 0.0);
    if (cost < best.cost) best = {header, std::move(bytes), cost};
}

Candidate best_plane(std::span<const int32_t> values, const PlanePredictor& predictor) {
    Candidate best;
    std::vector<int32_t> residuals(values.size());
    for (const Prediction prediction : {Prediction::none, Prediction::mean, Prediction::latest}) {
        if (prediction != Prediction::none && !predictor.has_mesh()) break;
        predictor.subtract(prediction, values, residuals);
        int32_t magnitude = 0;
        for (const int32_t r : residuals) magnitude = std::max(magnitude, std::abs(r));
        PlaneHeader header{prediction, Packing::nothing, 0};
        if (magnitude == 0) {
            consider(best, header, residuals);
            break;
        }
        if (magnitude <= kMaxPackedMagnitude) {
            consider(best, {prediction, Packing::packed, static_cast<uint8_t>(magnitude)},
                     residuals);
        }
        header.packing = magnitude <= 127 ? Packing::bytes : Packing::words;
        consider(best, header, residuals);
    }
    return best;
}

}  // namespace

std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort) {
    PAIM_CHECK(!values.holds_floats());
    PAIM_CHECK(num_planes > 0);
    const size_t num_points = values.size() / num_planes;
    PAIM_CHECK_EQ(num_points * num_planes, values.size());
    std::vector<uint8_t> contents(kHeaderBytes * num_planes);
    std::vector<size_t> ends{contents.size()};
    std::vector<int32_t> plane(num_points);
    for (size_t j = 0; j < num_planes; ++j) {
        values.for_each(j * num_points, num_points, [&](size_t n, float value) {
            plane[n - j * num_points] = static_cast<int32_t>(value);
        });
        const Candidate best = best_plane(plane, predictor);
        contents[kHeaderBytes * j] =
            static_cast<uint8_t>(static_cast<uint32_t>(best.header.prediction) |
                                 (static_cast<uint32_t>(best.header.packing) << 2));
        contents[kHeaderBytes * j + 1] = best.header.magnitude;
        contents.insert(contents.end(), best.bytes.begin(), best.bytes.end());
        ends.push_back(contents.size());
    }
    return zstd_compress(contents, ends, effort);
}

template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, std::span<Integer> out) {
    PAIM_CHECK(num_planes > 0);
    const size_t num_points = out.size() / num_planes;
    PAIM_CHECK_EQ(num_points * num_planes, out.size());
    const uint64_t most = kHeaderBytes * uint64_t{num_planes} + 2 * uint64_t{out.size()};
    const auto size = zstd_content_size(bytes);
    if (!size || *size > most || *size < kHeaderBytes * num_planes) return false;
    std::vector<uint8_t> contents(*size);
    if (!zstd_decompress(bytes, contents)) return false;

    size_t place = kHeaderBytes * num_planes;
    std::vector<int32_t> plane(num_points);
    for (size_t j = 0; j < num_planes; ++j) {
        const uint8_t how = contents[kHeaderBytes * j];
        const PlaneHeader header{static_cast<Prediction>(how & 3u),
                                 static_cast<Packing>((how >> 2) & 3u),
                                 contents[kHeaderBytes * j + 1]};
        if (how > 15 || header.prediction > Prediction::mean) return false;
        if (header.prediction != Prediction::none && !predictor.has_mesh()) return false;
        if (header.packing == Packing::packed
                ? header.magnitude < 1 || header.magnitude > kMaxPackedMagnitude
                : header.magnitude != 0) {
            return false;
        }
        const size_t plane_bytes = packed_size(header, num_points);
        if (plane_bytes > contents.size() - place) return false;
        if (!unpack(header, contents.data() + place, plane)) return false;
        place += plane_bytes;
        predictor.add(header.prediction, plane);
        for (size_t n = 0; n < num_points; ++n) {
            // Symmetrical, so that a value and its negative are both there or neither is.
            constexpr int32_t kMost = std::numeric_limits<Integer>::max();
            if (plane[n] > kMost || plane[n] < -kMost) return false;
            out[j * num_points + n] = static_cast<Integer>(plane[n]);
        }
    }
    return place == contents.size();
}

template bool decode_planes(std::span<const uint8_t>, size_t, const PlanePredictor&,
                            std::span<int8_t>);
template bool decode_planes(std::span<const uint8_t>, size_t, const PlanePredictor&,
                            std::span<int16_t>);

}  // namespace paim
