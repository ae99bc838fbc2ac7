// Integers of a surface, smoothed within their rounding.
// Based on: Zakhor 1992 (see the header)
#include "paim/codec/surface_smoothing.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>

#include "paim/base/check.h"
#include "paim/codec/smooth_planes.h"

namespace paim {

namespace {

// The largest magnitude of integers.
int32_t largest_magnitude(const StoredValues& stored) {
    PAIM_CHECK(!stored.holds_floats());
    return std::visit(
        [](const auto& values) {
            // Both ends in the type of the values, which vector units compare many at once.
            using Integer = std::conditional_t<sizeof(values[0]) == 1, int8_t, int16_t>;
            Integer lowest = 0, highest = 0;
            for (const auto value : values) {
                lowest = std::min(lowest, static_cast<Integer>(value));
                highest = std::max(highest, static_cast<Integer>(value));
            }
            return std::max(int32_t{highest}, -int32_t{lowest});
        },
        stored.values());
}

}  // namespace

SurfaceSmoother::SurfaceSmoother(const Topology& topology)
    : first_(size_t{topology.num_vertices} + 1), neighbours_(6 * topology.triangles.size()) {
    for (const Triangle& t : topology.triangles) {
        for (const uint32_t v : t) first_[v + 1] += 2;
    }
    for (size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    for (const Triangle& t : topology.triangles) {
        for (size_t j = 0; j < 3; ++j) {
            neighbours_[next[t[j]]++] = t[(j + 1) % 3];
            neighbours_[next[t[j]]++] = t[(j + 2) % 3];
        }
    }
}

void SurfaceSmoother::smooth(std::span<const float> stored, uint32_t rounds, float reach,
                             std::span<float> values) const {
    PAIM_CHECK_EQ(stored.size() + 1, first_.size());
    PAIM_CHECK_EQ(stored.size(), values.size());
    std::vector<float> before(values.size());
    for (uint32_t round = 0; round < rounds; ++round) {
        std::copy(values.begin(), values.end(), before.begin());
        for (size_t v = 0; v < values.size(); ++v) {
            const uint32_t begin = first_[v], end = first_[v + 1];
            if (begin == end) continue;
            float sum = 0.0f;
            for (uint32_t j = begin; j < end; ++j) sum += before[neighbours_[j]];
            const float mean = sum / static_cast<float>(end - begin);
            values[v] = std::clamp(0.5f * (before[v] + mean), stored[v] - reach, stored[v] + reach);
        }
    }
}

uint64_t SurfaceSmoother::bytes(uint64_t num_vertices, uint64_t num_triangles) {
    return sizeof(uint32_t) * (2 * num_vertices + 1 + 6 * num_triangles);
}

uint32_t smoothing_fraction_bits(const LowRank& matrix) {
    int32_t largest = largest_magnitude(matrix.mean);
    for (const StoredValues& values : matrix.components) {
        largest = std::max(largest, largest_magnitude(values));
    }
    for (const uint32_t bits : {4u, 3u, 2u}) {
        if ((2 * largest + 1) << (bits - 1) <= 32767) return bits;
    }
    return 0;
}

void smooth_stored(LowRank& matrix, const Topology& topology) {
    if (matrix.fraction_bits > 0) smooth_stored(matrix, SurfaceSmoother(topology));
}

void smooth_stored(LowRank& matrix, const SurfaceSmoother& smoother, VectorUnit unit) {
    if (matrix.fraction_bits == 0) return;
    const size_t num_arrays = 1 + matrix.components.size();
    PAIM_CHECK(matrix.smoothing.size() >= num_arrays * matrix.num_planes);
    std::vector<std::vector<int16_t>> smoothed(num_arrays);
    std::vector<PlaneToSmooth> planes;
    for (size_t array = 0; array < num_arrays; ++array) {
        smoothed[array].resize(matrix.num_rows());
        const StoredValues& stored = array == 0 ? matrix.mean : matrix.components[array - 1];
        for (size_t j = 0; j < matrix.num_planes; ++j) {
            const size_t first = j * matrix.num_points;
            planes.push_back({&stored, first, matrix.smoothing[array * matrix.num_planes + j],
                              smoothed[array].data() + first});
        }
    }
    smooth_planes(smoother, planes, matrix.fraction_bits, unit);
    matrix.mean = std::move(smoothed[0]);
    for (size_t k = 0; k + 1 < num_arrays; ++k) matrix.components[k] = std::move(smoothed[k + 1]);
    matrix.precision = Precision::i16;
    for (float& step : matrix.steps)
        step = std::ldexp(step, -static_cast<int>(matrix.fraction_bits));
}

StoredValues stored_integers(const StoredValues& smoothed, uint32_t fraction_bits) {
    const float scale = 1.0f / static_cast<float>(1u << fraction_bits);
    std::vector<int16_t> wide(smoothed.size());
    int16_t largest = 0;
    smoothed.for_each(0, wide.size(), [&](size_t j, float value) {
        wide[j] = static_cast<int16_t>(std::nearbyint(scale * value));
        largest = std::max<int16_t>(largest, static_cast<int16_t>(std::abs(wide[j])));
    });
    if (largest > largest_integer(Precision::i8)) return wide;
    return std::vector<int8_t>(wide.begin(), wide.end());
}

}  // namespace paim
