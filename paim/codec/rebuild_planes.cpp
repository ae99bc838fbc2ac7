// Rebuilds planes of a low-rank matrix.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
//           Geometry, 2012
#include "paim/codec/rebuild_planes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "paim/base/parallel.h"
#include "paim/codec/accumulate.h"

namespace paim {

void interpolate_weights(const LowRank& matrix, double time, std::vector<float>& weights) {
    const double last = static_cast<double>(matrix.num_poses) - 1.0;
    const double clamped = std::clamp(std::isnan(time) ? 0.0 : time, 0.0, last);
    const auto p = static_cast<size_t>(clamped);
    const size_t next = std::min(p + 1, size_t{matrix.num_poses} - 1);
    const auto fraction = static_cast<float>(clamped - static_cast<double>(p));
    weights.resize(matrix.num_components);
    for (uint32_t k = 0; k < matrix.num_components; ++k) {
        const float* row = matrix.weights.data() + size_t{k} * matrix.num_poses;
        weights[k] = row[p] + fraction * (row[next] - row[p]);
    }
}

void rebuild_planes(const LowRank& matrix, std::span<const uint32_t> planes,
                    std::span<const float> weights, uint32_t num_components,
                    std::vector<float>& out) {
    // Points a piece of work: enough that components are read in long runs, and few enough that all
    // threads have work even if there are only three planes.
    constexpr size_t kPoints = 8192;
    const size_t num_points = matrix.num_points;
    const size_t num_pieces = (num_points + kPoints - 1) / kPoints;
    out.resize(planes.size() * num_points);
    const std::span components = std::span(matrix.components).first(num_components);
    parallel_for(planes.size() * num_pieces, 1, [&](size_t task, size_t) {
        const size_t j = task / num_pieces;
        const size_t first = task % num_pieces * kPoints;
        const size_t count = std::min(kPoints, num_points - first);
        accumulate(matrix.mean, components, weights.first(num_components), matrix.step(planes[j]),
                   planes[j] * num_points + first,
                   std::span(out).subspan(j * num_points + first, count));
    });
}

void PositionDecoder::decode(const LowRank& positions, double time, uint32_t num_components,
                             std::vector<float>& out) {
    constexpr std::array<uint32_t, 3> kPlanes{0, 1, 2};
    interpolate_weights(positions, time, weights_);
    rebuild_planes(positions, kPlanes, weights_, std::min(num_components, positions.num_components),
                   out);
}

void PointDecoder::decode(const LowRank& matrix, const TransferLayout& whole, double time,
                          const DecodeLimits& limits, TransferLayout& layout,
                          std::vector<float>& out) {
    layout = whole.with_bands(limits.bands);
    planes_of(whole, layout, planes_);
    interpolate_weights(matrix, time, weights_);
    rebuild_planes(matrix, planes_, weights_,
                   std::min(limits.transfer_components, matrix.num_components), out);
}

Eigen::MatrixXf rebuild_sequence(const LowRank& matrix, uint32_t plane) {
    using Eigen::Index;
    const auto num_points = static_cast<Index>(matrix.num_points);
    const auto num_components = static_cast<Index>(matrix.num_components);
    const size_t first_row = plane * size_t{matrix.num_points};
    Eigen::VectorXf mean(num_points);
    matrix.mean.widen(first_row, std::span(mean.data(), matrix.num_points));
    Eigen::MatrixXf components(num_points, num_components);
    for (Index k = 0; k < num_components; ++k) {
        matrix.components[static_cast<size_t>(k)].widen(
            first_row, std::span(components.col(k).data(), matrix.num_points));
    }
    using Weights = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Weights> weights(matrix.weights.data(), num_components,
                                            static_cast<Index>(matrix.num_poses));
    Eigen::MatrixXf sequence = components * weights;
    sequence.colwise() += mean;
    return sequence * matrix.step(plane);
}

}  // namespace paim
