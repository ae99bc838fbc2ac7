// The basis of one direction, in double: normalised Legendre recurrences times (x + iy)^m.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013
#include "paim/sh/basis.h"

#include <array>
#include <cmath>

#include "paim/base/check.h"
#include "paim/sh/recurrence.h"

namespace paim::sh {

namespace {

const std::array<LegendreStep, kNumLegendreSteps>& legendre_steps() {
    static const auto steps = [] {
        std::array<LegendreStep, kNumLegendreSteps> table{};
        for (int m = 0, i = 0; m < kMaxBands; ++m) {
            for (int l = m; l < kMaxBands; ++l)
                table[static_cast<size_t>(i++)] = legendre_step(l, m);
        }
        return table;
    }();
    return steps;
}

template <typename T>
void evaluate(int bands, const Vec3d& direction, std::span<T> values) {
    PAIM_CHECK_LE(1, bands);
    PAIM_CHECK_LE(bands, kMaxBands);
    PAIM_CHECK_EQ(values.size(), static_cast<size_t>(num_coefficients(bands)));
    // If the direction is not unit, polynomials in z are wrong by l²/2 times the error of its
    // length.
    const Vec3d unit = direction.normalized();
    const LegendreStep* steps = legendre_steps().data();
    double cosine = 1.0;  // Re (x + iy)^m = sin^m θ cos mφ
    double sine = 0.0;    // Im (x + iy)^m
    double diagonal = std::sqrt(0.25 / kPi);
    for (int m = 0; m < bands; ++m) {
        if (m > 0) {
            diagonal *= diagonal_ratio(m);
            const double next = unit.x() * cosine - unit.y() * sine;
            sine = unit.x() * sine + unit.y() * cosine;
            cosine = next;
        }
        double before = 0.0;
        double legendre = diagonal;
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const double next = steps[l - m].a * unit.z() * legendre - steps[l - m].b * before;
                before = legendre;
                legendre = next;
            }
            values[static_cast<size_t>(index(l, m))] = static_cast<T>(legendre * cosine);
            if (m > 0) {
                values[static_cast<size_t>(index(l, -m))] = static_cast<T>(legendre * sine);
            }
        }
        steps += kMaxBands - m;
    }
}

}  // namespace

void evaluate_basis(int bands, const Vec3d& direction, std::span<float> values) {
    evaluate(bands, direction, values);
}

void evaluate_basis(int bands, const Vec3d& direction, std::span<double> values) {
    evaluate(bands, direction, values);
}

}  // namespace paim::sh
