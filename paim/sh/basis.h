// The real, orthonormal spherical-harmonic basis without Condon–Shortley phase, polar axis z.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013 (sin^m θ folded into
// the
//           azimuthal factor, so that nothing divides by it at the poles)
#pragma once

#include <span>
#include <vector>

#include "paim/base/vector.h"
#include "paim/sh/index.h"

namespace paim::sh {

// Evaluates all coefficients of one direction.
// bands      1 … kMaxBands
// direction  unit to 1e-4 (not checked)
// values     [bands²], i = l(l+1)+m
// note       computed in double, so that float results are right to float rounding at 64 bands
void evaluate_basis(int bands, const Vec3d& direction, std::span<float> values);
void evaluate_basis(int bands, const Vec3d& direction, std::span<double> values);

// Evaluates the basis for many directions at once, in float: the inner loop of the bake.
class BatchBasis {
  public:
    static constexpr int kBatch = 16;

    // bands 1 … kMaxBands
    explicit BatchBasis(int bands);

    int bands() const { return bands_; }

    // x, y, z  [kBatch] unit directions
    // values   [bands²][kBatch]
    // err      relative to the largest value of a band: a few float roundings times the band index
    void evaluate(const float* x, const float* y, const float* z, float* values) const;

  private:
    int bands_;
    std::vector<float> recurrence_;
};

}  // namespace paim::sh
