// Encodes planes of small integers.
//
// The contents of the Zstandard frame are: the headers of all planes; the packed symbols of all
// planes, grouped by magnitude; the gaps of all escapes, their low bytes and their high bytes.
#include "paim/format/pack/plane_encoder.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <variant>

#include "paim/base/check.h"
#include "paim/format/pack/plane_packing.h"
#include "paim/format/pack/plane_residuals.h"

namespace paim {

namespace {

using Counts = std::array<uint32_t, 256>;

Counts count_bytes(std::span<const uint8_t> bytes) {
    Counts counts{};
    for (const uint8_t byte : bytes) ++counts[byte];
    return counts;
}

// Estimated bits of a memoryless entropy coder for bytes with these counts, with its table.
double cost_bits(const Counts& counts) {
    constexpr double kTableBits = 5.0;  // for each byte value that occurs
    double total = 0.0, bits = 0.0;
    size_t num_used = 0;
    for (const uint32_t count : counts) {
        if (count == 0) continue;
        total += count;
        bits += kTableBits - count * std::log2(count);
        ++num_used;
    }
    if (num_used <= 1) return 16.0 * static_cast<double>(num_used);
    // A Huffman code of two or more byte values has at least one bit each.
    return std::max(bits + total * std::log2(total), total);
}

double cost_bits(const PackedPlane& plane) {
    return cost_bits(count_bytes(plane.symbols)) + cost_bits(count_bytes(plane.gaps)) +
           cost_bits(count_bytes(plane.lows)) + cost_bits(count_bytes(plane.highs));
}

// Estimated bits of residuals, for any packing. Zigzag numbers up to 31 are symbols of their own.
// Larger ones are grouped by their first three bits; their other bits are not compressed.
template <typename Integer>
double entropy_bits(std::span<const Integer> residuals) {
    constexpr uint32_t kSmall = 32;
    Counts counts{};
    double plain_bits = 0.0;
    for (const int32_t r : residuals) {
        const uint32_t code = zigzag(r);
        if (code < kSmall) {
            ++counts[code];
        } else {
            const auto shift = static_cast<uint32_t>(std::bit_width(code)) - 3;
            ++counts[kSmall + 4 * shift + ((code >> shift) & 3)];
            plain_bits += shift;
        }
    }
    return cost_bits(counts) + plain_bits;
}

template <typename Integer>
PackedPlane best_plane(std::span<const Integer> values, const PlanePredictor& predictor) {
    Prediction prediction = Prediction::none;
    std::vector<Integer> residuals(values.begin(), values.end()), other(values.size());
    double least = entropy_bits(values);
    for (const Prediction p : {Prediction::mean, Prediction::parallelograms}) {
        if (!predictor.has_mesh()) break;
        subtract_prediction(predictor, p, values, std::span(other));
        const double bits = entropy_bits(std::span<const Integer>(other));
        if (bits >= least) continue;
        least = bits;
        prediction = p;
        residuals.swap(other);
    }
    int32_t largest = 0;
    for (const int32_t r : residuals) largest = std::max(largest, std::abs(r));
    PackedPlane best;
    least = std::numeric_limits<double>::infinity();
    for (const uint8_t magnitude : kMagnitudes) {
        PackedPlane plane = pack(prediction, magnitude, std::span<const Integer>(residuals));
        // A price in bits for decoding time, so that of two equal packings that with fewer bytes
        // and escapes is chosen.
        constexpr double kBitsPerByte = 0.2, kBitsPerEscape = 0.4;
        const double bits = cost_bits(plane) +
                            kBitsPerByte * static_cast<double>(plane.symbols.size()) +
                            kBitsPerEscape * static_cast<double>(plane.gaps.size());
        if (bits < least) {
            least = bits;
            best = std::move(plane);
        }
        if (magnitude >= largest) break;
    }
    return best;
}

// Bytes of a frame, and the offsets where their statistics change so much that a new table pays.
class Contents {
  public:
    void append(std::span<const uint8_t> some) {
        if (some.empty()) return;
        const Counts counts = count_bytes(some);
        Counts both = counts;
        for (size_t j = 0; j < both.size(); ++j) both[j] += counts_[j];
        const double bits = cost_bits(counts), bits_of_both = cost_bits(both);
        // Price of a block: starting one takes as much decoding time as about 25 bytes.
        constexpr double kBlockBits = 8.0 * 25.0;
        if (bits_ + bits + kBlockBits < bits_of_both) {
            block_ends.push_back(bytes.size());
            counts_ = counts;
            bits_ = bits;
        } else {
            counts_ = both;
            bits_ = bits_of_both;
        }
        bytes.insert(bytes.end(), some.begin(), some.end());
    }

    std::vector<uint8_t> bytes;
    std::vector<size_t> block_ends;

  private:
    Counts counts_{};
    double bits_ = 0.0;
};

void append_header(const PlaneHeader& header, std::vector<uint8_t>& bytes) {
    bytes.push_back(
        static_cast<uint8_t>(static_cast<uint32_t>(header.prediction) | (header.wide ? 4u : 0u)));
    bytes.push_back(header.magnitude);
    for (int shift = 0; shift < 32; shift += 8) {
        bytes.push_back(static_cast<uint8_t>(header.num_escapes >> shift));
    }
}

template <typename Integer>
std::vector<uint8_t> encode(std::span<const Integer> values, size_t num_planes,
                            const PlanePredictor& predictor, Effort effort) {
    const size_t num_points = values.size() / num_planes;
    std::vector<PackedPlane> planes;
    std::vector<uint8_t> headers;
    for (size_t j = 0; j < num_planes; ++j) {
        planes.push_back(best_plane(values.subspan(j * num_points, num_points), predictor));
        append_header(planes.back().header, headers);
    }
    Contents contents;
    contents.append(headers);
    for (const uint8_t magnitude : kMagnitudes) {
        for (const PackedPlane& plane : planes) {
            if (plane.header.magnitude == magnitude) contents.append(plane.symbols);
        }
    }
    for (const PackedPlane& plane : planes) contents.append(plane.gaps);
    for (const PackedPlane& plane : planes) contents.append(plane.lows);
    for (const PackedPlane& plane : planes) contents.append(plane.highs);
    return zstd_compress_noise(contents.bytes, contents.block_ends, effort);
}

}  // namespace

std::vector<uint8_t> encode_planes(const StoredValues& values, size_t num_planes,
                                   const PlanePredictor& predictor, Effort effort) {
    PAIM_CHECK(!values.holds_floats());
    PAIM_CHECK(num_planes > 0);
    PAIM_CHECK_EQ(values.size() % num_planes, 0u);
    if (values.holds_i8()) {
        const auto& integers = std::get<std::vector<int8_t>>(values.values());
        return encode(std::span(integers), num_planes, predictor, effort);
    }
    const auto& integers = std::get<std::vector<int16_t>>(values.values());
    return encode(std::span(integers), num_planes, predictor, effort);
}

}  // namespace paim
