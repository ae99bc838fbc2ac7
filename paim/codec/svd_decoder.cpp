// The reference decoder: M + U·W, plane by plane.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#include "paim/codec/svd_decoder.h"

#include <algorithm>
#include <cmath>

#include "paim/base/parallel.h"

namespace paim {

namespace {

// out[plane_count][V] = the given planes of mean + Σ_k weights[k] · component_k.
// planes  the matrix's plane numbers to rebuild, in the order of out
void rebuild(const LowRankMatrix& matrix, const std::vector<uint32_t>& planes,
             const std::vector<float>& weights, uint32_t num_components, std::vector<float>& out) {
    const size_t num_vertices = matrix.num_vertices;
    out.resize(planes.size() * num_vertices);
    const size_t num_rows = matrix.num_rows();
    parallel_for(planes.size(), 1, [&](size_t j, size_t) {
        const size_t first_row = planes[j] * num_vertices;
        float* plane = out.data() + j * num_vertices;
        std::copy_n(matrix.mean.data() + first_row, num_vertices, plane);
        for (uint32_t k = 0; k < num_components; ++k) {
            const float weight = weights[k];
            const float* component = matrix.components.data() + k * num_rows + first_row;
            for (size_t v = 0; v < num_vertices; ++v) plane[v] += weight * component[v];
        }
    });
}

}  // namespace

void interpolate_weights(const LowRankMatrix& matrix, double time, std::vector<float>& weights) {
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

void SvdDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) const {
    std::vector<float> weights;
    interpolate_weights(model_.geometry, time, weights);
    rebuild(model_.geometry, {0, 1, 2}, weights,
            std::min(limits.geometry_components, model_.geometry.num_components), out.positions);

    out.layout = model_.layout;
    out.layout.bands = std::clamp(limits.bands, 1u, model_.layout.bands);
    std::vector<uint32_t> planes;
    for (uint32_t channel = 0; channel < out.layout.channels; ++channel) {
        for (uint32_t i = 0; i < out.layout.num_coefficients(); ++i) {
            planes.push_back(model_.layout.plane(channel, i));
        }
    }
    interpolate_weights(model_.transfer, time, weights);
    rebuild(model_.transfer, planes, weights,
            std::min(limits.transfer_components, model_.transfer.num_components), out.transfer);
}

}  // namespace paim
