// Rebuilding a low-rank matrix: mean + components · weights, for one pose or for all of them (E4).
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/model.h"

namespace paim {

// The weights of all components at `time` (in poses, clamped to 0 … P−1), linearly interpolated.
// weights [K]
void interpolate_weights(const LowRankMatrix& matrix, double time, std::vector<float>& weights);

// out[j][N] = plane planes[j] of mean + Σ_k weights[k] · component k, steps applied, with the first
// num_components components. The same numbers in the same order give the same bytes, whatever was
// rebuilt before and on any number of threads.
void rebuild_planes(const LowRankMatrix& matrix, std::span<const uint32_t> planes,
                    std::span<const float> weights, uint32_t num_components,
                    std::vector<float>& out);

// One plane in all poses. returns [N][P]
Eigen::MatrixXf rebuild_sequence(const LowRankMatrix& matrix, uint32_t plane);

}  // namespace paim
