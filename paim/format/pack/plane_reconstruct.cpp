// Reconstructs planes from packed residuals, many planes at once.
//
// A value depends on earlier values of its plane, so a single plane is a chain of additions that
// wait for one another. Here a row holds the values of many planes at one vertex, and rows are
// predicted from rows. Symbols are unpacked and transposed into rows, escapes are added to the
// rows, and rows are transposed back into planes, in tiles that stay in the first-level cache.
// Values in rows have their highest bit flipped, because vector units have an instruction for means
// of two unsigned numbers.
#include "paim/format/pack/plane_reconstruct.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

#include "paim/base/check.h"
#include "paim/format/pack/plane_unpacking.h"

namespace paim {

namespace {

constexpr size_t kVectorBytes = 16;

typedef uint8_t Bytes __attribute__((vector_size(kVectorBytes)));
typedef uint16_t Words __attribute__((vector_size(kVectorBytes)));

// A vector of a row: one integer of each of kLanes planes.
template <typename Integer>
struct Lanes {
    using Lane = std::make_unsigned_t<Integer>;
    using Vector = std::conditional_t<sizeof(Integer) == 1, Bytes, Words>;
    static constexpr size_t kLanes = kVectorBytes / sizeof(Integer);
    static constexpr auto kHighest = static_cast<Lane>(Lane{1} << (8 * sizeof(Lane) - 1));
};
static_assert(kTileValues % Lanes<int8_t>::kLanes == 0);

// ⌊(a + b + 1) / 2⌋, without the overflow.
#if defined(__SSE2__)
__attribute__((always_inline)) inline Bytes mean_of_two(const Bytes& a, const Bytes& b) {
    return Bytes(_mm_avg_epu8(__m128i(a), __m128i(b)));
}
__attribute__((always_inline)) inline Words mean_of_two(const Words& a, const Words& b) {
    return Words(_mm_avg_epu16(__m128i(a), __m128i(b)));
}
#else
template <typename Vector>
__attribute__((always_inline)) inline Vector mean_of_two(const Vector& a, const Vector& b) {
    return (a | b) - ((a ^ b) >> 1);
}
#endif

// ⌊(a + b + c + d + 2) / 4⌋. The mean of two means is too large by one where both the difference of
// the means and the difference of the values of one of them are odd.
template <typename Vector>
__attribute__((always_inline)) inline Vector mean_of_four(const Vector& a, const Vector& b,
                                                          const Vector& c, const Vector& d) {
    const Vector ab = mean_of_two(a, b), cd = mean_of_two(c, d);
    return mean_of_two(ab, cd) - (((a ^ b) | (c ^ d)) & (ab ^ cd) & 1);
}

// Interleaves the lower or the higher halves of both registers: a0 b0 a1 b1 …
#if defined(__SSE2__)
__attribute__((always_inline)) inline Bytes interleave_low(const Bytes& a, const Bytes& b) {
    return Bytes(_mm_unpacklo_epi8(__m128i(a), __m128i(b)));
}
__attribute__((always_inline)) inline Bytes interleave_high(const Bytes& a, const Bytes& b) {
    return Bytes(_mm_unpackhi_epi8(__m128i(a), __m128i(b)));
}
__attribute__((always_inline)) inline Words interleave_low(const Words& a, const Words& b) {
    return Words(_mm_unpacklo_epi16(__m128i(a), __m128i(b)));
}
__attribute__((always_inline)) inline Words interleave_high(const Words& a, const Words& b) {
    return Words(_mm_unpackhi_epi16(__m128i(a), __m128i(b)));
}
#else
template <typename Vector>
__attribute__((always_inline)) inline Vector interleave(const Vector& a, const Vector& b,
                                                        size_t first) {
    Vector result;
    for (size_t j = 0; j < sizeof(Vector) / sizeof(result[0]); ++j) {
        result[j] = (j % 2 == 0 ? a : b)[first + j / 2];
    }
    return result;
}
template <typename Vector>
__attribute__((always_inline)) inline Vector interleave_low(const Vector& a, const Vector& b) {
    return interleave(a, b, 0);
}
template <typename Vector>
__attribute__((always_inline)) inline Vector interleave_high(const Vector& a, const Vector& b) {
    return interleave(a, b, sizeof(Vector) / sizeof(a[0]) / 2);
}
#endif

// Transposes as many vectors as each has lanes, by one bit of the row number at a time.
template <typename Vector, size_t kSize>
__attribute__((always_inline)) inline void transpose(Vector (&m)[kSize]) {
    Vector from[kSize];
#pragma GCC unroll 4
    for (size_t bit = 1; bit < kSize; bit *= 2) {
#pragma GCC unroll 16
        for (size_t j = 0; j < kSize; ++j) from[j] = m[j];
#pragma GCC unroll 8
        for (size_t j = 0; j < kSize / 2; ++j) {
            m[2 * j] = interleave_low(from[j], from[j + kSize / 2]);
            m[2 * j + 1] = interleave_high(from[j], from[j + kSize / 2]);
        }
    }
}

// Reconstructs a plane without prediction, whose values are its residuals.
template <typename Integer>
bool copy_plane(const PlaneSource<Integer>& plane, size_t num_points) {
    using Lane = typename Lanes<Integer>::Lane;
    const PlaneHeader& header = plane.header;
    Integer tile[kTileValues + kTilePadding];
    for (size_t first = 0; first < num_points && header.magnitude > 0; first += kTileValues) {
        const size_t count = std::min(kTileValues, num_points - first);
        unpack_symbols(header.magnitude, plane.symbols, first, count, tile);
        std::copy_n(tile, count, plane.out + first);
    }
    if (header.magnitude == 0) std::fill_n(plane.out, num_points, Integer{0});
    auto* const values = reinterpret_cast<Lane*>(plane.out);
    Escapes escapes(header, plane.gaps, plane.lows, plane.highs);
    escapes.add_until(num_points, [values](size_t n) -> Lane& { return values[n]; });
    Lane any_lowest = 0;
    for (size_t n = 0; n < num_points && header.num_escapes + header.magnitude > 0; ++n) {
        any_lowest = static_cast<Lane>(any_lowest | (values[n] == Lanes<Integer>::kHighest));
    }
    return escapes.done() && any_lowest == 0;
}

// Reconstructs up to kLanes · kVectors predicted planes. Planes predicted by means come first.
template <typename Integer, size_t kVectors>
class Reconstruction {
  public:
    using Vector = typename Lanes<Integer>::Vector;
    using Lane = typename Lanes<Integer>::Lane;
    static constexpr size_t kLanes = Lanes<Integer>::kLanes;

    // Values of all planes at a vertex.
    struct alignas(kVectorBytes* kVectors) Row {
        Vector vectors[kVectors];
    };

    Reconstruction(std::span<const PlaneSource<Integer>> planes, const PlanePredictor& predictor,
                   size_t num_points, Buffer& rows)
        : planes_(planes),
          num_points_(num_points),
          // A row of zeros for missing neighbours, one row a vertex, and padding of the last block.
          rows_(reinterpret_cast<Row*>(rows.resize((1 + num_points + kLanes) * sizeof(Row)))),
          parents_(predictor.parents()) {
        PAIM_CHECK_EQ(parents_.size(), num_points);
        for (Vector& vector : rows_[0].vectors) vector = Vector{} + Lanes<Integer>::kHighest;
        size_t num_means = 0;
        for (size_t j = 0; j < planes.size(); ++j) {
            const PlaneSource<Integer>& plane = planes[j];
            escapes_[j] = Escapes(plane.header, plane.gaps, plane.lows, plane.highs);
            num_means += plane.header.prediction == Prediction::mean;
            if (plane.header.magnitude > 0) has_symbols_[j / kLanes] = true;
        }
        num_mean_vectors_ = (num_means + kLanes - 1) / kLanes;
        is_mixed_ = num_means < planes.size() && num_means % kLanes != 0;
        for (size_t j = 0; j < num_means % kLanes; ++j) means_[j] = static_cast<Lane>(-1);
        if (num_means == planes.size()) num_mean_vectors_ = kVectors;
        if (num_means < planes.size()) parallelograms_ = predictor.parallelograms();
    }

    bool run() {
        for (size_t first = 0; first < num_points_; first += kTileValues) {
            const size_t count = std::min(kTileValues, num_points_ - first);
            read(first, count);
            add_some(first, count);
            write(first, count);
        }
        return finished();
    }

  private:
    // Unpacks the residuals of the tile into rows.
    __attribute__((noinline)) void read(size_t first, size_t count) {
        Row* const rows = rows_ + 1 + first;
        for (size_t j = 0; j < planes_.size(); ++j) {
            if (const uint8_t magnitude = planes_[j].header.magnitude; magnitude > 0) {
                unpack_symbols(magnitude, planes_[j].symbols, first, count, tile_[j]);
            }
        }
        for (size_t k = 0; k < kVectors; ++k) {
            if (!has_symbols_[k]) {
                for (size_t n = 0; n < count; ++n) rows[n].vectors[k] = Vector{};
                continue;
            }
            for (size_t n = 0; n < count; n += kLanes) {
                Vector block[kLanes];
#pragma GCC unroll 16
                for (size_t i = 0; i < kLanes; ++i) {
                    std::memcpy(&block[i], tile_[k * kLanes + i] + n, sizeof(Vector));
                }
                transpose(block);
#pragma GCC unroll 16
                for (size_t i = 0; i < kLanes; ++i) rows[n + i].vectors[k] = block[i];
            }
        }
        auto* const lanes = reinterpret_cast<Lane*>(rows_);
        for (size_t j = 0; j < planes_.size(); ++j) {
            Lane* const column = lanes + kLanes * kVectors + j;
            escapes_[j].add_until(first + count, [column](size_t n) -> Lane& {
                return column[kLanes * kVectors * n];
            });
        }
    }

    // Predicts rows from rows: the first kMeans vectors by means, the last kSlopes by
    // parallelograms. A vector that belongs to both is predicted by one or the other in each lane.
    template <size_t kMeans, size_t kSlopes>
    __attribute__((noinline)) void add(size_t first, size_t count) {
        static_assert(kMeans + kSlopes == kVectors || kMeans + kSlopes == kVectors + 1);
        Row* const rows = rows_;
        for (size_t n = first; n < first + count; ++n) {
            Vector mixed{};
            if constexpr (kMeans > 0) {
                const PlanePredictor::Parents& parents = parents_[n];
                const Row& a = rows[parents[0]];
                const Row& b = rows[parents[1]];
                const Row& c = rows[parents[2]];
                const Row& d = rows[parents[3]];
#pragma GCC unroll 4
                for (size_t k = 0; k < kMeans; ++k) {
                    const Vector mean =
                        mean_of_four(a.vectors[k], b.vectors[k], c.vectors[k], d.vectors[k]);
                    if (k + kSlopes < kVectors) {
                        rows[1 + n].vectors[k] += mean;
                    } else {
                        mixed = mean & means_;
                    }
                }
            }
            if constexpr (kSlopes > 0) {
                const auto& [one, other] = parallelograms_[n];
                const Row& a = rows[one.a];
                const Row& b = rows[one.b];
                const Row& c = rows[one.c];
                const Row& e = rows[other.a];
                const Row& f = rows[other.b];
                const Row& g = rows[other.c];
#pragma GCC unroll 4
                for (size_t k = kVectors - kSlopes; k < kVectors; ++k) {
                    const Vector complete =
                        mean_of_two(Vector(a.vectors[k] + b.vectors[k] - c.vectors[k]),
                                    Vector(e.vectors[k] + f.vectors[k] - g.vectors[k]));
                    rows[1 + n].vectors[k] += k < kMeans ? mixed | (complete & ~means_) : complete;
                }
            }
        }
    }

    // Calls the add() with the number of vectors of means as template argument.
    template <size_t kMeans = 0>
    void add_some(size_t first, size_t count) {
        if constexpr (kMeans < kVectors) {
            if (num_mean_vectors_ > kMeans) return add_some<kMeans + 1>(first, count);
        }
        if constexpr (kMeans > 0) {
            if (is_mixed_) return add<kMeans, kVectors + 1 - kMeans>(first, count);
        }
        add<kMeans, kVectors - kMeans>(first, count);
    }

    __attribute__((noinline)) void write(size_t first, size_t count) {
        const size_t whole = count - count % kLanes;
        Vector any_lowest{};
        for (size_t j = 0; j < planes_.size(); j += kLanes) {
            const size_t num_used = std::min(kLanes, planes_.size() - j);
            Integer* to[kLanes];
            for (size_t i = 0; i < kLanes; ++i) {
                to[i] = planes_[j + std::min(i, num_used - 1)].out + first;
            }
            Vector block[kLanes];
            for (size_t n = 0; n < whole; n += kLanes) {
                load_columns(first + n, j / kLanes, block);
                if (num_used == kLanes) {
#pragma GCC unroll 16
                    for (size_t i = 0; i < kLanes; ++i) {
                        any_lowest |= Vector(block[i] == 0);
                        store(block[i], to[i] + n);
                    }
                    continue;
                }
                for (size_t i = 0; i < num_used; ++i) {
                    any_lowest |= Vector(block[i] == 0);
                    store(block[i], to[i] + n);
                }
            }
            if (whole == count) continue;
            load_columns(first + whole, j / kLanes, block);
            for (size_t i = 0; i < num_used; ++i) {
                Integer all[kLanes];
                store(block[i], all);
                std::copy_n(all, count - whole, to[i] + whole);
                for (size_t n = 0; n < count - whole; ++n) {
                    any_lowest[0] |= static_cast<Lane>(block[i][n] == 0);
                }
            }
        }
        any_lowest_ |= any_lowest;
    }

    // block[i] = plane i of vector `vector` of the rows, at the kLanes points from n on.
    __attribute__((always_inline)) void load_columns(size_t n, size_t vector,
                                                     Vector (&block)[kLanes]) const {
#pragma GCC unroll 16
        for (size_t i = 0; i < kLanes; ++i) block[i] = rows_[1 + n + i].vectors[vector];
        transpose(block);
    }

    __attribute__((always_inline)) static void store(const Vector& turned, Integer* out) {
        const Vector values = turned ^ Lanes<Integer>::kHighest;
        std::memcpy(out, &values, sizeof(values));
    }

    bool finished() const {
        for (size_t j = 0; j < planes_.size(); ++j) {
            if (!escapes_[j].done()) return false;
        }
        for (size_t j = 0; j < kLanes; ++j) {
            if (any_lowest_[j] != 0) return false;
        }
        return true;
    }

    std::span<const PlaneSource<Integer>> planes_;
    size_t num_points_;
    Row* rows_;
    std::span<const PlanePredictor::Parents> parents_;
    std::span<const PlanePredictor::Parallelograms> parallelograms_;
    size_t num_mean_vectors_ = 0;  // the first vectors of a row are predicted by means
    bool is_mixed_ = false;        // some lanes of the last of these are parallelograms
    bool has_symbols_[kVectors] = {};
    Vector means_{};  // all bits are set in those lanes of the mixed vector that are means
    Vector any_lowest_{};
    Escapes escapes_[kLanes * kVectors];
    Integer tile_[kLanes * kVectors][kTileValues + kTilePadding] = {};  // symbols
};

}  // namespace

template <typename Integer>
bool reconstruct_planes(std::span<PlaneSource<Integer>> planes, const PlanePredictor& predictor,
                        size_t num_points, Buffer& rows) {
    // Planes with the same prediction are put together, and among these those without symbols
    // first.
    std::stable_sort(planes.begin(), planes.end(), [](const auto& a, const auto& b) {
        const auto rank = [](const PlaneHeader& header) {
            return 2 * static_cast<int>(header.prediction) + (header.magnitude > 0);
        };
        return rank(a.header) < rank(b.header);
    });
    constexpr size_t kLanes = Lanes<Integer>::kLanes;
    for (size_t first = 0; first < planes.size();) {
        if (planes[first].header.prediction == Prediction::none) {
            if (!copy_plane(planes[first], num_points)) return false;
            ++first;
            continue;
        }
        const size_t count = std::min(4 * kLanes, planes.size() - first);
        const std::span<const PlaneSource<Integer>> some = planes.subspan(first, count);
        const bool good = count <= kLanes
                              ? Reconstruction<Integer, 1>(some, predictor, num_points, rows).run()
                          : count <= 2 * kLanes
                              ? Reconstruction<Integer, 2>(some, predictor, num_points, rows).run()
                              : Reconstruction<Integer, 4>(some, predictor, num_points, rows).run();
        if (!good) return false;
        first += count;
    }
    return true;
}

template bool reconstruct_planes(std::span<PlaneSource<int8_t>>, const PlanePredictor&, size_t,
                                 Buffer&);
template bool reconstruct_planes(std::span<PlaneSource<int16_t>>, const PlanePredictor&, size_t,
                                 Buffer&);

}  // namespace paim
