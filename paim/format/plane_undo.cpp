// Planes from packed residuals: many planes at once.
//
// A value depends on values before it in its plane, so that a plane alone is a chain of additions
// that wait for one another. Here a row has the values of up to 32 planes at a vertex, and rows are
// predicted from rows. Planes are unpacked and transposed into rows, and rows back into planes, in
// tiles that stay in the first-level cache.
#include "paim/format/plane_undo.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstring>
#include <limits>
#include <vector>

#include "paim/base/check.h"

namespace paim {

namespace {

constexpr size_t kBlock = 8;  // values that are transposed at once, either way
static_assert(kTileValues % kBlock == 0);

typedef int16_t Eight __attribute__((vector_size(2 * kBlock)));
typedef uint16_t Wrapping __attribute__((vector_size(2 * kBlock)));

// Eight rows of eight become columns.
__attribute__((always_inline)) inline void transpose(Eight (&m)[kBlock]) {
    Eight a[kBlock], b[kBlock];
#pragma GCC unroll 4
    for (size_t j = 0; j < 4; ++j) {
        a[2 * j] = __builtin_shufflevector(m[j], m[j + 4], 0, 8, 1, 9, 2, 10, 3, 11);
        a[2 * j + 1] = __builtin_shufflevector(m[j], m[j + 4], 4, 12, 5, 13, 6, 14, 7, 15);
    }
#pragma GCC unroll 4
    for (size_t j = 0; j < 4; ++j) {
        b[2 * j] = __builtin_shufflevector(a[j], a[j + 4], 0, 8, 1, 9, 2, 10, 3, 11);
        b[2 * j + 1] = __builtin_shufflevector(a[j], a[j + 4], 4, 12, 5, 13, 6, 14, 7, 15);
    }
#pragma GCC unroll 4
    for (size_t j = 0; j < 4; ++j) {
        m[2 * j] = __builtin_shufflevector(b[j], b[j + 4], 0, 8, 1, 9, 2, 10, 3, 11);
        m[2 * j + 1] = __builtin_shufflevector(b[j], b[j + 4], 4, 12, 5, 13, 6, 14, 7, 15);
    }
}

// Whether all values so far were in the symmetrical range of the integers.
template <typename Integer>
class RangeCheck {
  public:
    __attribute__((always_inline)) void add(const Eight& values) {
        most_ = values > most_ ? values : most_;
        least_ = values < least_ ? values : least_;
    }
    bool passed() const {
        constexpr int16_t kMost = std::numeric_limits<Integer>::max();
        for (size_t j = 0; j < kBlock; ++j) {
            if (most_[j] > kMost || least_[j] < -kMost) return false;
        }
        return true;
    }

  private:
    Eight most_{}, least_{};
};

template <typename Integer>
__attribute__((always_inline)) inline void store(const Eight& values, Integer* out) {
    typedef Integer Narrow __attribute__((vector_size(kBlock * sizeof(Integer))));
    const Narrow narrow = __builtin_convertvector(values, Narrow);
    std::memcpy(out, &narrow, sizeof(narrow));
}

// The first so many of eight.
template <typename Integer>
void store_some(const Eight& values, size_t count, Integer* out) {
    Integer all[kBlock];
    store(values, all);
    std::copy_n(all, count, out);
}

template <typename Integer>
void copy_plane(const PackedPlane& plane, size_t num_points, Integer* out,
                RangeCheck<Integer>& range) {
    int16_t tile[kTileValues + kTilePadding];
    for (size_t first = 0; first < num_points; first += kTileValues) {
        const size_t count = std::min(kTileValues, num_points - first);
        unpack_tile(plane.header, plane.source, num_points, first, count, tile);
        std::fill_n(tile + count, kTilePadding, int16_t{0});
        for (size_t j = 0; j < count; j += kBlock) {
            Eight values;
            std::memcpy(&values, tile + j, sizeof(values));
            range.add(values);
            if (count - j >= kBlock) {
                store(values, out + first + j);
            } else {
                store_some(values, count - j, out + first + j);
            }
        }
    }
}

// ⌊a · b / 65536⌋, lane by lane.
__attribute__((always_inline)) inline Eight high_half(const Eight& a, const Eight& b) {
#if defined(__SSE2__)
    // Which the compiler does not find by itself if b is the same in all lanes.
    return Eight(_mm_mulhi_epi16(__m128i(a), __m128i(b)));
#else
    Eight product;
    for (size_t j = 0; j < kBlock; ++j) {
        product[j] = static_cast<int16_t>((int32_t{a[j]} * b[j]) >> 16);
    }
    return product;
#endif
}

// 65536 / (2 · divisor), rounded up: right for numerators up to 10,000 and divisors of 3 and 4.
constexpr int16_t reciprocal(int divisor) {
    return static_cast<int16_t>((65536 + 2 * divisor - 1) / (2 * divisor));
}

__attribute__((always_inline)) inline Wrapping all_lanes(int value) {
    return Wrapping{} + static_cast<uint16_t>(value);
}

// The mean of four parents, or of three and a row of zeros, as PlanePredictor has it, in arithmetic of
// 16 bits that wraps around.
template <typename Integer>
struct Mean {
    __attribute__((always_inline)) explicit Mean(bool three)
        : divisor(all_lanes(three ? 3 : 4)),
          share(Eight(all_lanes(three ? 21846 : 16384))),
          half_share(Eight(all_lanes(reciprocal(three ? 3 : 4)))) {}

    Wrapping divisor;
    Eight share;  // of 65536: 1 / divisor
    Eight half_share;

    // Of any values: their sum comes in parts, as it does not fit. Quarters, and what is left of them, 0
    // to 12; quarters again are divisor · quotient + remainder, with a remainder of 0 to 3.
    __attribute__((always_inline)) Wrapping operator()(const Wrapping& a, const Wrapping& b,
                                                       const Wrapping& c, const Wrapping& d) const {
        const Eight quarters =
            (Eight(a) >> 2) + (Eight(b) >> 2) + (Eight(c) >> 2) + (Eight(d) >> 2);
        const auto rest = a + b + c + d - 4 * Wrapping(quarters);
        const auto quotient = Wrapping(high_half(quarters, share));
        const auto remainder = Wrapping(quarters) - quotient * divisor;
        const auto numerator = 8 * remainder + 2 * rest + divisor;
        return 4 * quotient + Wrapping(high_half(Eight(numerator), half_share));
    }
};

// Of values in range, whose sum fits.
template <>
struct Mean<int8_t> {
    // Makes the numerator positive: no mean of values in range is less.
    static constexpr int kPositive = 512;

    __attribute__((always_inline)) explicit Mean(bool three)
        : offset(all_lanes((three ? 3 : 4) * (1 + 2 * kPositive))),
          half_share(Eight(all_lanes(reciprocal(three ? 3 : 4)))) {}

    Wrapping offset;
    Eight half_share;

    __attribute__((always_inline)) Wrapping operator()(const Wrapping& a, const Wrapping& b,
                                                       const Wrapping& c, const Wrapping& d) const {
        const auto numerator = 2 * (a + b + c + d) + offset;
        return Wrapping(high_half(Eight(numerator), half_share)) - kPositive;
    }
};

// Values of planes at a vertex.
template <size_t kLanes>
struct alignas(2 * kLanes) Row {
    Wrapping eight[kLanes / kBlock];
};

template <typename Integer, size_t kLanes>
class Undo {
  public:
    using Rows = Row<kLanes>;

    // planes, outs [up to kLanes]
    Undo(std::span<const PackedPlane> planes, std::span<Integer* const> outs,
         const PlanePredictor& predictor, size_t num_points, ScratchPool::Buffer& rows)
        : planes_(planes),
          outs_(outs),
          parents_(predictor.parents()),
          num_points_(num_points),
          // Nobody's, then one a vertex, then what completes the last block.
          rows_(reinterpret_cast<Rows*>(rows.resize((1 + num_points + kBlock) * sizeof(Rows)))) {
        PAIM_CHECK_EQ(parents_.size(), num_points);
        rows_[0] = {};
        for (size_t j = 0; j < planes.size(); ++j) {
            const bool mean = planes[j].header.prediction == Prediction::mean;
            means_.eight[j / kBlock][j % kBlock] = mean ? 0xffff : 0;
            all_means_ = all_means_ && mean;
        }
    }

    void run(RangeCheck<Integer>& range) {
        for (size_t first = 0; first < num_points_; first += kTileValues) {
            const size_t count = std::min(kTileValues, num_points_ - first);
            read(first, count);
            if (all_means_) {
                add<true>(first, count);
            } else {
                add<false>(first, count);
            }
            write(first, count, range);
        }
    }

  private:
    __attribute__((noinline)) void read(size_t first, size_t count) {
        for (size_t j = 0; j < planes_.size(); ++j) {
            unpack_tile(planes_[j].header, planes_[j].source, num_points_, first, count, tile_[j]);
            std::fill_n(tile_[j] + count, kTilePadding, int16_t{0});
        }
        for (size_t n = 0; n < count; n += kBlock) {
            for (size_t j = 0; j < planes_.size(); j += kBlock) {
                Eight block[kBlock];
                for (size_t i = 0; i < kBlock; ++i) {
                    std::memcpy(&block[i], tile_[j + i] + n, sizeof(Eight));
                }
                transpose(block);
                for (size_t i = 0; i < kBlock; ++i) {
                    rows_[1 + first + n + i].eight[j / kBlock] = Wrapping(block[i]);
                }
            }
        }
    }

    template <bool kAllMeans>
    __attribute__((noinline)) void add(size_t first, size_t count) {
        for (size_t n = first; n < first + count; ++n) {
            const PlanePredictor::Parents& parents = parents_[n];
            const Mean<Integer> mean(parents.has_three());
            const Rows& a = rows_[parents.row[0]];
            const Rows& b = rows_[parents.row[1]];
            const Rows& c = rows_[parents.row[2]];
            const Rows& d = rows_[parents.row[3]];
            Rows& row = rows_[1 + n];
#pragma GCC unroll 4
            for (size_t j = 0; j < kLanes / kBlock; ++j) {
                Wrapping predicted = mean(a.eight[j], b.eight[j], c.eight[j], d.eight[j]);
                if constexpr (!kAllMeans) {
                    predicted = (predicted & means_.eight[j]) | (a.eight[j] & ~means_.eight[j]);
                }
                row.eight[j] += predicted;
            }
        }
    }

    __attribute__((noinline)) void write(size_t first, size_t count, RangeCheck<Integer>& range) {
        const size_t whole = count - count % kBlock;
        for (size_t j = 0; j < planes_.size(); j += kBlock) {
            const size_t num_used = std::min(kBlock, planes_.size() - j);
            Integer* to[kBlock];
            for (size_t i = 0; i < kBlock; ++i)
                to[i] = outs_[j + std::min(i, num_used - 1)] + first;
            Eight block[kBlock];
            for (size_t n = 0; n < whole; n += kBlock) {
                load_columns(first + n, j, block, range);
                if (num_used == kBlock) {
#pragma GCC unroll 8
                    for (size_t i = 0; i < kBlock; ++i) store(block[i], to[i] + n);
                } else {
                    for (size_t i = 0; i < num_used; ++i) store(block[i], to[i] + n);
                }
            }
            if (whole == count) continue;
            load_columns(first + whole, j, block, range);
            for (size_t i = 0; i < num_used; ++i) {
                store_some(block[i], count - whole, to[i] + whole);
            }
        }
    }

    // block[i] = plane j + i at eight points from n on. Lanes that no plane has are zero.
    __attribute__((always_inline)) void load_columns(size_t n, size_t j, Eight (&block)[kBlock],
                                                     RangeCheck<Integer>& range) const {
#pragma GCC unroll 8
        for (size_t i = 0; i < kBlock; ++i) {
            block[i] = Eight(rows_[1 + n + i].eight[j / kBlock]);
            range.add(block[i]);
        }
        transpose(block);
    }

    std::span<const PackedPlane> planes_;
    std::span<Integer* const> outs_;
    std::span<const PlanePredictor::Parents> parents_;
    size_t num_points_;
    Rows* rows_;
    bool all_means_ = true;
    Rows means_{};                                           // every bit of a lane
    int16_t tile_[kLanes][kTileValues + kTilePadding] = {};  // residuals
};

}  // namespace

template <typename Integer>
bool undo_planes(std::span<const PackedPlane> planes, const PlanePredictor& predictor,
                 size_t num_points, ScratchPool::Buffer& rows, Integer* out) {
    RangeCheck<Integer> range;
    std::vector<PackedPlane> predicted;
    std::vector<Integer*> outs;
    for (size_t j = 0; j < planes.size(); ++j) {
        if (planes[j].header.prediction == Prediction::none) {
            copy_plane(planes[j], num_points, out + j * num_points, range);
        } else {
            predicted.push_back(planes[j]);
            outs.push_back(out + j * num_points);
        }
    }
    for (size_t first = 0; first < predicted.size();) {
        const size_t count = std::min<size_t>(32, predicted.size() - first);
        const auto some = std::span(predicted).subspan(first, count);
        const auto to = std::span<Integer* const>(outs).subspan(first, count);
        if (count <= 8) {
            Undo<Integer, 8>(some, to, predictor, num_points, rows).run(range);
        } else if (count <= 16) {
            Undo<Integer, 16>(some, to, predictor, num_points, rows).run(range);
        } else {
            Undo<Integer, 32>(some, to, predictor, num_points, rows).run(range);
        }
        first += count;
    }
    return range.passed();
}

template bool undo_planes(std::span<const PackedPlane>, const PlanePredictor&, size_t,
                          ScratchPool::Buffer&, int8_t*);
template bool undo_planes(std::span<const PackedPlane>, const PlanePredictor&, size_t,
                          ScratchPool::Buffer&, int16_t*);

}  // namespace paim
