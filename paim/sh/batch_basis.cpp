// Sixteen directions at once, in float: the recurrences of basis.cpp over arrays of lanes, in loops
// that compilers turn into vector code on every machine. Based on: Peter-Pike Sloan, Efficient
// Spherical Harmonic Evaluation, 2013
#include <cstring>

#include "paim/base/check.h"
#include "paim/sh/basis.h"
#include "paim/sh/recurrence.h"

namespace paim::sh {

namespace {

// A vector register on every machine we know (SSE2, NEON); GCC and Clang do arithmetic on it
// directly.
using Lanes = float __attribute__((vector_size(16)));
constexpr int kNumLanes = 4;
constexpr int kNumRegisters = BatchBasis::kBatch / kNumLanes;

// One value of every direction.
struct Batch {
    Lanes v[kNumRegisters];
};

Batch load(const float* from) {
    Batch batch;
    std::memcpy(&batch, from, sizeof batch);
    return batch;
}

Batch constant(float value) {
    const Lanes lanes = {value, value, value, value};
    return {{lanes, lanes, lanes, lanes}};
}

}  // namespace

// recurrence_ holds, for each m: the diagonal q_mm, then a and b of each l = m+1 … bands−1.
BatchBasis::BatchBasis(int bands) : bands_(bands) {
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, kMaxBands);
    double diagonal = std::sqrt(0.25 / kPi);
    for (int m = 0; m < bands; ++m) {
        if (m > 0) diagonal *= diagonal_ratio(m);
        recurrence_.push_back(static_cast<float>(diagonal));
        for (int l = m + 1; l < bands; ++l) {
            const LegendreStep step = legendre_step(l, m);
            recurrence_.push_back(static_cast<float>(step.a));
            recurrence_.push_back(static_cast<float>(step.b));
        }
    }
}

// sink(i, a, b) takes coefficient i of all directions as the product of two batches.
template <typename Weights, typename Sink>
void BatchBasis::run(const float* x, const float* y, const float* z, const Weights& weights,
                     const Sink& sink) const {
    const Batch bx = load(x);
    const Batch by = load(y);
    const Batch bz = load(z);
    Batch cosine = weights;       // sin^m θ cos mφ, weighted
    Batch sine = constant(0.0f);  // sin^m θ sin mφ, weighted
    const float* step = recurrence_.data();
    for (int m = 0; m < bands_; ++m) {
        if (m > 0) {
            for (int r = 0; r < kNumRegisters; ++r) {
                const Lanes next = bx.v[r] * cosine.v[r] - by.v[r] * sine.v[r];
                sine.v[r] = bx.v[r] * sine.v[r] + by.v[r] * cosine.v[r];
                cosine.v[r] = next;
            }
        }
        Batch legendre = constant(*step++);
        Batch before = constant(0.0f);
        for (int l = m;; ++l) {
            sink(index(l, m), legendre, cosine);
            if (m > 0) sink(index(l, -m), legendre, sine);
            if (l + 1 == bands_) break;
            const Batch a = constant(*step++);
            const Batch b = constant(*step++);
            for (int r = 0; r < kNumRegisters; ++r) {
                // a·z first: it does not wait for the last step.
                const Lanes next = a.v[r] * bz.v[r] * legendre.v[r] - b.v[r] * before.v[r];
                before.v[r] = legendre.v[r];
                legendre.v[r] = next;
            }
        }
    }
}

void BatchBasis::evaluate(const float* x, const float* y, const float* z, float* values) const {
    run(x, y, z, constant(1.0f), [values](int i, const Batch& a, const Batch& b) {
        float* to = values + static_cast<ptrdiff_t>(i) * kBatch;
        for (int r = 0; r < kNumRegisters; ++r) {
            const Lanes product = a.v[r] * b.v[r];
            std::memcpy(to + r * kNumLanes, &product, sizeof product);
        }
    });
}

void BatchBasis::accumulate(const float* x, const float* y, const float* z, const float* weights,
                            float* sums) const {
    static_assert(kSumLanes == kNumLanes && kNumRegisters == 4);
    run(x, y, z, load(weights), [sums](int i, const Batch& a, const Batch& b) {
        float* to = sums + static_cast<ptrdiff_t>(i) * kSumLanes;
        Lanes sum;
        std::memcpy(&sum, to, sizeof sum);
        sum += (a.v[0] * b.v[0] + a.v[1] * b.v[1]) + (a.v[2] * b.v[2] + a.v[3] * b.v[3]);
        std::memcpy(to, &sum, sizeof sum);
    });
}

}  // namespace paim::sh
