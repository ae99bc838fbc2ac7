// Smooths many planes of integers at once.
//
// A round reads each vertex's neighbours, which lie anywhere in a plane. Here a row holds the values
// of many planes at one vertex, so that each neighbour is found once for all of them.
#include "paim/codec/smooth_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/line_allocator.h"
#include "paim/base/parallel.h"
#include "paim/codec/vector_kernels.h"

namespace paim {

namespace {

constexpr size_t kTile = 64;  // vertices whose rows are turned into planes at once
constexpr size_t kVerticesATask = 2048;
static_assert(kVerticesATask % kTile == 0);

using Rows = std::vector<float, LineAllocator<float>>;  // [V, rounded up to tiles][planes]
using Tile = std::array<std::array<float, kTile>, kSmoothedPlanes>;

typedef float FourFloats __attribute__((vector_size(16)));

// The vertices, those of few neighbours first within each run of kVerticesATime. Vertices that lie
// together in memory stay together, and loops over neighbours mostly end as the one before did, which
// processors predict.
std::vector<uint32_t> order_by_neighbours(std::span<const uint32_t> first) {
    constexpr size_t kVerticesATime = 256;
    constexpr uint32_t kMost = 31;  // those of more neighbours are not told apart
    const size_t num_vertices = first.size() - 1;
    const auto kind = [&](size_t v) { return std::min((first[v + 1] - first[v]) / 2, kMost); };
    std::vector<uint32_t> order(num_vertices);
    for (size_t begin = 0; begin < num_vertices; begin += kVerticesATime) {
        const size_t end = std::min(begin + kVerticesATime, num_vertices);
        std::array<size_t, kMost + 2> next{};  // place of the next vertex of each kind
        for (size_t v = begin; v < end; ++v) ++next[kind(v) + 1];
        next[0] = begin;
        std::partial_sum(next.begin(), next.end(), next.begin());
        for (size_t v = begin; v < end; ++v) order[next[kind(v)]++] = static_cast<uint32_t>(v);
    }
    return order;
}

// Turns four rows of four floats into columns.
void transpose(const float* from, size_t from_stride, float* to, size_t to_stride) {
    std::array<FourFloats, 4> m;
    for (size_t j = 0; j < 4; ++j) __builtin_memcpy(&m[j], from + j * from_stride, sizeof(m[j]));
    const FourFloats ab_low = __builtin_shufflevector(m[0], m[1], 0, 4, 1, 5);
    const FourFloats ab_high = __builtin_shufflevector(m[0], m[1], 2, 6, 3, 7);
    const FourFloats cd_low = __builtin_shufflevector(m[2], m[3], 0, 4, 1, 5);
    const FourFloats cd_high = __builtin_shufflevector(m[2], m[3], 2, 6, 3, 7);
    m[0] = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    m[1] = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    m[2] = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    m[3] = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
    for (size_t j = 0; j < 4; ++j) __builtin_memcpy(to + j * to_stride, &m[j], sizeof(m[j]));
}

// Up to kSmoothedPlanes planes, as rows.
class PlaneRows {
  public:
    PlaneRows(const SurfaceSmoother& smoother, VectorUnit unit)
        : smoother_(smoother),
          use_(vector_kernels(unit)),
          num_vertices_(smoother.first().size() - 1),
          order_(order_by_neighbours(smoother.first())),
          rows_((num_vertices_ + kTile - 1) / kTile * kTile * kSmoothedPlanes),
          next_(rows_.size()) {}

    // planes  in descending order of rounds
    void run(std::span<const PlaneToSmooth> planes, uint32_t fraction_bits) {
        for_each_tile([&](size_t v, size_t count) { fill(planes, v, count); });
        SmoothingRound round;
        round.first = smoother_.first().data();
        round.neighbours = smoother_.neighbours().data();
        round.order = order_.data();
        round.reach = smoothing_reach(fraction_bits);
        for (uint32_t done = 0; done < planes[0].rounds; ++done) {
            round.before = rows_.data();
            round.after = next_.data();
            for (size_t j = 0; j < planes.size(); ++j) {
                round.active[j] = done < planes[j].rounds ? -1 : 0;
            }
            parallel_for(num_vertices_, kVerticesATask,
                         [&](size_t begin, size_t end) { use_.smooth(round, begin, end); });
            std::swap(rows_, next_);
        }
        for_each_tile([&](size_t v, size_t count) { store(planes, fraction_bits, v, count); });
    }

  private:
    template <typename Use>
    void for_each_tile(const Use& use) const {
        parallel_for(num_vertices_, kVerticesATask, [&](size_t begin, size_t end) {
            for (size_t v = begin; v < end; v += kTile) use(v, std::min(kTile, end - v));
        });
    }

    void fill(std::span<const PlaneToSmooth> planes, size_t v, size_t count) {
        Tile tile{};
        for (size_t j = 0; j < planes.size(); ++j) {
            const StoredValues& stored = *planes[j].stored;
            use_.widen(type_of(stored), values_from(stored, planes[j].first + v), tile[j].data(),
                       count);
        }
        for (size_t n = 0; n < kTile; n += 4) {
            for (size_t j = 0; j < kSmoothedPlanes; j += 4) {
                transpose(tile[j].data() + n, kTile, rows_.data() + kSmoothedPlanes * (v + n) + j,
                          kSmoothedPlanes);
            }
        }
    }

    void store(std::span<const PlaneToSmooth> planes, uint32_t fraction_bits, size_t v,
               size_t count) const {
        Tile tile;
        for (size_t n = 0; n < kTile; n += 4) {
            for (size_t j = 0; j < kSmoothedPlanes; j += 4) {
                transpose(rows_.data() + kSmoothedPlanes * (v + n) + j, kSmoothedPlanes,
                          tile[j].data() + n, kTile);
            }
        }
        const auto scale = static_cast<float>(1u << fraction_bits);
        for (size_t j = 0; j < planes.size(); ++j) {
            int16_t* const out = planes[j].out + v;
            for (size_t n = 0; n < count; ++n) {
                // The sum is rounded to an integer, which its lowest bits are.
                const float sum = scale * tile[j][n] + kRoundToInteger;
                out[n] = static_cast<int16_t>(std::bit_cast<uint32_t>(sum));
            }
        }
    }

    const SurfaceSmoother& smoother_;
    const VectorKernels& use_;
    size_t num_vertices_;
    std::vector<uint32_t> order_;
    Rows rows_, next_;
};

// The plane alone, value by value.
void smooth_plain(const SurfaceSmoother& smoother, const PlaneToSmooth& plane,
                  uint32_t fraction_bits) {
    const size_t num_vertices = smoother.first().size() - 1;
    std::vector<float> stored(num_vertices);
    plane.stored->widen(plane.first, stored);
    std::vector<float> values = stored;
    smoother.smooth(stored, plane.rounds, smoothing_reach(fraction_bits), values);
    const auto scale = static_cast<float>(1u << fraction_bits);
    std::transform(values.begin(), values.end(), plane.out, [&](float value) {
        return static_cast<int16_t>(std::nearbyint(scale * value));
    });
}

// A plane of no rounds.
void shift(const PlaneToSmooth& plane, uint32_t fraction_bits, size_t num_vertices) {
    const int factor = 1 << fraction_bits;
    std::visit(
        [&](const auto& values) {
            for (size_t n = 0; n < num_vertices; ++n) {
                plane.out[n] =
                    static_cast<int16_t>(static_cast<int16_t>(values[plane.first + n]) * factor);
            }
        },
        plane.stored->values());
}

}  // namespace

void smooth_planes(const SurfaceSmoother& smoother, std::span<const PlaneToSmooth> planes,
                   uint32_t fraction_bits, VectorUnit unit) {
    PAIM_CHECK(fraction_bits > 0);
    for (const PlaneToSmooth& plane : planes) PAIM_CHECK(!plane.stored->holds_floats());
    if (unit == VectorUnit::plain) {
        for (const PlaneToSmooth& plane : planes) smooth_plain(smoother, plane, fraction_bits);
        return;
    }
    // Planes that take about as many rounds are put together.
    std::vector<PlaneToSmooth> ordered(planes.begin(), planes.end());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [](const auto& a, const auto& b) { return a.rounds > b.rounds; });
    const auto still = std::find_if(ordered.begin(), ordered.end(),
                                    [](const auto& plane) { return plane.rounds == 0; });
    const auto num_moving = static_cast<size_t>(still - ordered.begin());
    const std::span<const PlaneToSmooth> all(ordered);
    const size_t num_vertices = smoother.first().size() - 1;
    for (const PlaneToSmooth& plane : all.subspan(num_moving)) {
        shift(plane, fraction_bits, num_vertices);
    }
    if (num_moving == 0) return;
    PlaneRows rows(smoother, unit);
    for (size_t j = 0; j < num_moving; j += kSmoothedPlanes) {
        rows.run(all.subspan(j, std::min(kSmoothedPlanes, num_moving - j)), fraction_bits);
    }
}

}  // namespace paim
