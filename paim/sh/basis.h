// The real, orthonormal spherical-harmonic basis without Condon–Shortley phase, polar axis z.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013 (sin^m θ is part of the
//           azimuthal factor, so that nothing divides by it at the poles)
#pragma once

#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/sh/index.h"

namespace paim::sh {

// Evaluates all coefficients of one direction.
// bands      1 … kMaxBands
// direction  not zero; its length does not matter
// values     [bands²], i = l(l+1)+m
// err        relative to the largest value of a band, sqrt((2l+1)/4π): 1e-15 at 3 bands, 1e-14 at
//            10, 4e-13 at 64 (2^-53 · l², largest near the poles), before rounding to float
void evaluate_basis(int bands, const Vec3d& direction, std::span<float> values);
void evaluate_basis(int bands, const Vec3d& direction, std::span<double> values);

// Evaluates the basis for many directions at once, to float: the inner loop of the bake.
class BatchBasis {
  public:
    static constexpr int kBatch = 16;

    // bands 1 … kMaxBands
    explicit BatchBasis(int bands);

    int bands() const { return bands_; }

    // x, y, z  [kBatch] unit directions, or zero
    // values   [bands²][kBatch]
    // err      relative to the largest value of a band, sqrt((2l+1)/4π), and to the direction
    //          before it was rounded to float: 5e-7 at 5 bands, 3e-6 at 10, 8e-6 at 16
    //          (2^-24 · l²/2, largest near the poles); 2e-6 at 17 to 64, which are computed in
    //          double
    // cost     about 130 ps a value with SSE2 up to 16 bands (50 ns for 5 bands, 180 ns for 10, 420
    //          ns for 16), 270 ps a value above (17 µs for 64)
    void evaluate(const float* x, const float* y, const float* z, float* values) const;

    // Adds Σ_j weights[j] · y_i(direction j) to each coefficient's sum. It costs as much as
    // evaluate() alone, because the recurrences start from the weights.
    // weights  [kBatch]
    // sums     [bands²][kSumLanes]; the sum of a coefficient is the sum of its lanes
    // err      that of evaluate() for each weighted value, and the rounding of float sums
    static constexpr int kSumLanes = 4;
    void accumulate(const float* x, const float* y, const float* z, const float* weights,
                    float* sums) const;

  private:
    int bands_;
    std::vector<float> float_recurrence_;  // which of the two is used depends on the bands
    std::vector<double> double_recurrence_;
};

}  // namespace paim::sh
