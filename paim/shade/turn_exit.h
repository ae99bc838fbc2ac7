// Outgoing radiance of vertices, turned from their frames to the axes of the pose.
#pragma once

#include <span>

#include "paim/base/vector.h"

namespace paim {

// For each row the coefficients of g(v) = Σ_k exit(k) y_k(Fᵀ v), per channel; F is its frame, and k are
// the even coefficients (sh/index.h). In each band, g is known from its values in more directions than
// the band has coefficients, by least squares, which costs much less than a matrix of rotation for
// each vertex. Deterministic on any number of threads.
// out_bands  1 … kMaxOutBands
// frames     [R] columns x, y, z, orthonormal and right-handed
// exit       [out_bands (out_bands + 1) / 2][R] linear RGB
// turned     [out_bands²][R]
// err        2e-6 relative to the norm of a row's coefficients
void turn_exit(int out_bands, std::span<const Eigen::Matrix3f> frames, std::span<const Vec3f> exit,
               std::span<Vec3f> turned);

}  // namespace paim
