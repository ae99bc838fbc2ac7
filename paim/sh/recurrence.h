// Coefficients of the normalised Legendre recurrences that both basis evaluations run.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013
#pragma once

#include <cmath>

#include "paim/sh/index.h"

namespace paim::sh {

// With q_lm(z) = y_lm / Re (x + iy)^m, which already holds the normalisation:
// q_lm = a z q_{l-1,m} − b q_{l-2,m} for l > m, where q_{m-1,m} = 0. Up to 64 bands values stay far
// inside float's range (the largest, near the poles, is about 1e13).
struct LegendreStep {
    double a;
    double b;
};

constexpr int kNumLegendreSteps = kMaxBands * (kMaxBands + 1) / 2;

// The step to q_lm, 0 <= m <= l. Both coefficients are 0 for l = m, which diagonal_ratio() gives.
inline LegendreStep legendre_step(int l, int m) {
    if (l == m) return {0.0, 0.0};
    const double l2 = static_cast<double>(l) * l;
    const double m2 = static_cast<double>(m) * m;
    const double k2 = static_cast<double>(l - 1) * (l - 1);
    const double a = std::sqrt((4.0 * l2 - 1.0) / (l2 - m2));
    return {a, a * std::sqrt((k2 - m2) / (4.0 * k2 - 1.0))};
}

// q_mm / q_{m-1,m-1}, m >= 1. The √2 of all m > 0 enters at m = 1.
inline double diagonal_ratio(int m) {
    return std::sqrt((m == 1 ? 2.0 : 1.0) * (2.0 * m + 1.0) / (2.0 * m));
}

}  // namespace paim::sh
