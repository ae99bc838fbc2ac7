// Planes of small integers as bytes.
//
// The contents of the frame: the planes' headers, then their residuals one after the other.
#include "paim/format/plane_codec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paim/base/check.h"
#include "paim/format/plane_packing.h"
#include "paim/format/plane_undo.h"

namespace paim {

namespace {

constexpr size_t kHeaderBytes = 2;

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
    return zstd_compress_numbers(contents, ends, effort);
}

template <typename Integer>
bool decode_planes(std::span<const uint8_t> bytes, size_t num_planes,
                   const PlanePredictor& predictor, ScratchPool& pool, std::span<Integer> out) {
    PAIM_CHECK(num_planes > 0);
    const size_t num_points = out.size() / num_planes;
    PAIM_CHECK_EQ(num_points * num_planes, out.size());
    const uint64_t most = kHeaderBytes * uint64_t{num_planes} + 2 * uint64_t{out.size()};
    const auto size = zstd_content_size(bytes);
    if (!size || *size > most || *size < kHeaderBytes * num_planes) return false;
    ScratchPool::Lease scratch(pool);
    auto* const contents = reinterpret_cast<uint8_t*>((*scratch).contents.resize(*size));
    if (!zstd_decompress(bytes, std::span(contents, *size))) return false;

    size_t place = kHeaderBytes * num_planes;
    std::vector<PackedPlane> planes(num_planes);
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
        if (plane_bytes > *size - place) return false;
        planes[j] = {header, contents + place};
        place += plane_bytes;
    }
    return place == *size &&
           undo_planes(planes, predictor, num_points, (*scratch).rows, out.data());
}

template bool decode_planes(std::span<const uint8_t>, size_t, const PlanePredictor&, ScratchPool&,
                            std::span<int8_t>);
template bool decode_planes(std::span<const uint8_t>, size_t, const PlanePredictor&, ScratchPool&,
                            std::span<int16_t>);

}  // namespace paim
