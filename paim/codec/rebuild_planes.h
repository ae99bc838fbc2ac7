// Rebuilds planes of a low-rank matrix, mean + components · weights, in one pose or in all (E4).
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/decode_limits.h"
#include "paim/codec/low_rank.h"
#include "paim/transfer/layout.h"

namespace paim {

// The weights of all components at `time` (in poses, clamped to 0 … P−1), linearly interpolated.
// weights [K]
void interpolate_weights(const LowRank& matrix, double time, std::vector<float>& weights);

// out[j][N] = plane planes[j] of mean + Σ_k weights[k] · component k, steps applied, with the first
// num_components components. The same `planes` give the same bytes on any number of threads,
// whatever was rebuilt before.
void rebuild_planes(const LowRank& matrix, std::span<const uint32_t> planes,
                    std::span<const float> weights, uint32_t num_components,
                    std::vector<float>& out);

// Positions at `time`, with the first num_components components. Keeps its memory between calls.
class PositionDecoder {
  public:
    // out [3][V] scene units
    void decode(const LowRank& positions, double time, uint32_t num_components,
                std::vector<float>& out);

  private:
    std::vector<float> weights_;
};

// The transfer of every point of a matrix at `time`. Keeps its memory between calls.
class PointDecoder {
  public:
    // whole   the layout of the matrix's planes
    // layout  the same, bands as limited
    // out     [layout.num_planes()][points]
    void decode(const LowRank& matrix, const TransferLayout& whole, double time,
                const DecodeLimits& limits, TransferLayout& layout, std::vector<float>& out);

  private:
    std::vector<float> weights_;
    std::vector<uint32_t> planes_;
};

// Rebuilds one plane in all poses.
// returns  [N][P], steps applied
Eigen::MatrixXf rebuild_sequence(const LowRank& matrix, uint32_t plane);

}  // namespace paim
