// The basis of sixteen directions at once: the recurrences of basis.cpp over arrays of lanes, in
// loops that compilers vectorise on every machine. Up to 16 bands are computed in float, more in
// double.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013
#include <cmath>
#include <cstring>

#include "paim/base/check.h"
#include "paim/sh/basis.h"
#include "paim/sh/recurrence.h"

namespace paim::sh {

namespace {

// With more bands floats lose too much: near a pole one rounding of z, or of a step of the
// recurrence, changes y_l0 by up to l(l+1)/2 roundings, 2^-24 · 2016 = 1.2e-4 at 64 bands, although
// x and y still give the exact distance to the pole. In double, with z computed from x and y, only
// the rounding of the result is left.
constexpr int kMaxFloatBands = 16;

// A vector register of SSE2 and NEON. GCC and Clang do arithmetic on this type directly.
using Floats = float __attribute__((vector_size(16)));
using Doubles = double __attribute__((vector_size(16)));

// One value for each of the directions.
template <typename Register>
struct Batch {
    using Scalar = std::remove_reference_t<decltype(Register{}[0])>;
    static constexpr int kNumLanes = sizeof(Register) / sizeof(Scalar);
    static constexpr int kNumRegisters = BatchBasis::kBatch / kNumLanes;
    Register v[kNumRegisters];
};

template <typename Register, typename Scalar>
Batch<Register> load(const Scalar* from) {
    alignas(sizeof(Register)) typename Batch<Register>::Scalar values[BatchBasis::kBatch];
    for (int j = 0; j < BatchBasis::kBatch; ++j) values[j] = from[j];
    Batch<Register> batch;
    std::memcpy(&batch, values, sizeof batch);
    return batch;
}

template <typename Register>
Batch<Register> constant(typename Batch<Register>::Scalar value) {
    Batch<Register> batch;
    for (Register& lanes : batch.v) lanes = Register{} + value;
    return batch;
}

template <typename Register>
struct Directions {
    Batch<Register> x, y, z;
};

Directions<Floats> load_floats(const float* x, const float* y, const float* z) {
    return {load<Floats>(x), load<Floats>(y), load<Floats>(z)};
}

// Scales directions to unit length, which rounding to float changed. Zero stays zero.
Directions<Doubles> load_doubles(const float* x, const float* y, const float* z) {
    double unit[3][BatchBasis::kBatch];
    for (int j = 0; j < BatchBasis::kBatch; ++j) {
        const double dx = x[j], dy = y[j], dz = z[j];
        const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
        const double scale = length > 0.0 ? 1.0 / length : 0.0;
        unit[0][j] = scale * dx;
        unit[1][j] = scale * dy;
        unit[2][j] = scale * dz;
    }
    return {load<Doubles>(unit[0]), load<Doubles>(unit[1]), load<Doubles>(unit[2])};
}

// sink(i, a, b) takes coefficient i of all directions as the product of two batches.
template <typename Register, typename Sink>
void run(int bands, const typename Batch<Register>::Scalar* step,
         const Directions<Register>& directions, const Batch<Register>& weights, const Sink& sink) {
    constexpr int kNumRegisters = Batch<Register>::kNumRegisters;
    const auto& [x, y, z] = directions;
    Batch<Register> cosine = weights;              // sin^m θ cos mφ, weighted
    Batch<Register> sine = constant<Register>(0);  // sin^m θ sin mφ, weighted
    for (int m = 0; m < bands; ++m) {
        if (m > 0) {
            for (int r = 0; r < kNumRegisters; ++r) {
                const Register next = x.v[r] * cosine.v[r] - y.v[r] * sine.v[r];
                sine.v[r] = x.v[r] * sine.v[r] + y.v[r] * cosine.v[r];
                cosine.v[r] = next;
            }
        }
        Batch<Register> legendre = constant<Register>(*step++);
        Batch<Register> before = constant<Register>(0);
        for (int l = m;; ++l) {
            sink(index(l, m), legendre, cosine);
            if (m > 0) sink(index(l, -m), legendre, sine);
            if (l + 1 == bands) break;
            const Batch<Register> a = constant<Register>(*step++);
            const Batch<Register> b = constant<Register>(*step++);
            for (int r = 0; r < kNumRegisters; ++r) {
                // a·z comes first because it does not depend on the previous step.
                const Register next = a.v[r] * z.v[r] * legendre.v[r] - b.v[r] * before.v[r];
                before.v[r] = legendre.v[r];
                legendre.v[r] = next;
            }
        }
    }
}

// Stores products of two batches as floats.
struct Store {
    float* values;

    void operator()(int i, const Batch<Floats>& a, const Batch<Floats>& b) const {
        float* to = values + static_cast<ptrdiff_t>(i) * BatchBasis::kBatch;
        for (int r = 0; r < Batch<Floats>::kNumRegisters; ++r) {
            const Floats product = a.v[r] * b.v[r];
            std::memcpy(to + r * Batch<Floats>::kNumLanes, &product, sizeof product);
        }
    }
    void operator()(int i, const Batch<Doubles>& a, const Batch<Doubles>& b) const {
        float* to = values + static_cast<ptrdiff_t>(i) * BatchBasis::kBatch;
        for (int r = 0; r < Batch<Doubles>::kNumRegisters; ++r) {
            const Doubles product = a.v[r] * b.v[r];
            to[2 * r] = static_cast<float>(product[0]);
            to[2 * r + 1] = static_cast<float>(product[1]);
        }
    }
};

// Adds products of two batches to sums; lane j adds directions j, j + 4, j + 8 and j + 12.
struct Add {
    float* sums;
    static_assert(BatchBasis::kSumLanes == Batch<Floats>::kNumLanes);
    static_assert(BatchBasis::kBatch == 16);

    void operator()(int i, const Batch<Floats>& a, const Batch<Floats>& b) const {
        float* to = sums + static_cast<ptrdiff_t>(i) * BatchBasis::kSumLanes;
        Floats sum;
        std::memcpy(&sum, to, sizeof sum);
        sum += (a.v[0] * b.v[0] + a.v[1] * b.v[1]) + (a.v[2] * b.v[2] + a.v[3] * b.v[3]);
        std::memcpy(to, &sum, sizeof sum);
    }
    void operator()(int i, const Batch<Doubles>& a, const Batch<Doubles>& b) const {
        float* to = sums + static_cast<ptrdiff_t>(i) * BatchBasis::kSumLanes;
        for (int half = 0; half < 2; ++half) {
            const Doubles sum = (a.v[half] * b.v[half] + a.v[half + 2] * b.v[half + 2]) +
                                (a.v[half + 4] * b.v[half + 4] + a.v[half + 6] * b.v[half + 6]);
            to[2 * half] += static_cast<float>(sum[0]);
            to[2 * half + 1] += static_cast<float>(sum[1]);
        }
    }
};

// Recurrence coefficients: for each m the value q_mm, then a and b of l = m+1 … bands−1.
template <typename Scalar>
std::vector<Scalar> recurrence(int bands) {
    std::vector<Scalar> values;
    double diagonal = std::sqrt(0.25 / kPi);
    for (int m = 0; m < bands; ++m) {
        if (m > 0) diagonal *= diagonal_ratio(m);
        values.push_back(static_cast<Scalar>(diagonal));
        for (int l = m + 1; l < bands; ++l) {
            const LegendreStep step = legendre_step(l, m);
            values.push_back(static_cast<Scalar>(step.a));
            values.push_back(static_cast<Scalar>(step.b));
        }
    }
    return values;
}

}  // namespace

BatchBasis::BatchBasis(int bands) : bands_(bands) {
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, kMaxBands);
    if (bands <= kMaxFloatBands) {
        float_recurrence_ = recurrence<float>(bands);
    } else {
        double_recurrence_ = recurrence<double>(bands);
    }
}

void BatchBasis::evaluate(const float* x, const float* y, const float* z, float* values) const {
    if (bands_ <= kMaxFloatBands) {
        run(bands_, float_recurrence_.data(), load_floats(x, y, z), constant<Floats>(1),
            Store{values});
    } else {
        run(bands_, double_recurrence_.data(), load_doubles(x, y, z), constant<Doubles>(1),
            Store{values});
    }
}

void BatchBasis::accumulate(const float* x, const float* y, const float* z, const float* weights,
                            float* sums) const {
    if (bands_ <= kMaxFloatBands) {
        run(bands_, float_recurrence_.data(), load_floats(x, y, z), load<Floats>(weights),
            Add{sums});
    } else {
        run(bands_, double_recurrence_.data(), load_doubles(x, y, z), load<Doubles>(weights),
            Add{sums});
    }
}

}  // namespace paim::sh
