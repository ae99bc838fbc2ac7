// Lights clustered transfer: rebuilds the bases of a pose, lights them, then sums them to vertices.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "paim/codec/cpca/cpca_player.h"

#include <algorithm>
#include <array>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/accumulate.h"

namespace paim {

namespace {

constexpr size_t kBlock = 512;  // rows whose planes and sums stay in the first-level cache
using Plane = std::array<float, kBlock>;

// Rows of the bases of one pose, in steps: rebuilt when needed, or kept from an earlier frame.
struct PoseRows {
    const LowRank& matrix;
    std::span<const float> weights;  // of the components in use
    std::span<const float> kept;     // [planes][rows], or empty

    // Rows [first, first + count) of a plane. They are in `scratch` if they had to be rebuilt.
    const float* rows(uint32_t plane, size_t first, size_t count, Plane& scratch) const {
        const size_t start = size_t{plane} * matrix.num_points + first;
        if (!kept.empty()) return kept.data() + start;
        rebuild(start, std::span(scratch).first(count));
        return scratch.data();
    }
    void rebuild(size_t start, std::span<float> out) const {
        accumulate(matrix.mean, std::span(matrix.components).first(weights.size()), weights, 1.0f,
                   start, out);
    }
};

// Sums the radiance of some rows under a light, plane by plane.
struct LitRows {
    const PoseRows& pose;
    uint32_t num_channels;
    size_t first = 0;
    size_t count = 0;
    Plane scratch = {};
    std::array<Plane, 3> sums = {};

    // Grey transfer contributes to all channels.
    void add(uint32_t plane_index, uint32_t channel, const Vec3f& incident) {
        const float* const plane = pose.rows(plane_index, first, count, scratch);
        const Vec3f light = pose.matrix.step(plane_index) * incident;
        if (num_channels == 3) {
            Plane& sum = sums[channel];
            for (size_t j = 0; j < count; ++j) sum[j] += light[channel] * plane[j];
            return;
        }
        for (size_t j = 0; j < count; ++j) {
            sums[0][j] += light[0] * plane[j];
            sums[1][j] += light[1] * plane[j];
            sums[2][j] += light[2] * plane[j];
        }
    }
};

}  // namespace

CpcaPlayer::CpcaPlayer(const CpcaTransfer& transfer, const TransferLayout& layout)
    : transfer_(transfer), layout_(layout) {
    PAIM_CHECK_EQ(transfer.matrix.num_points, transfer.clusters.num_rows());
    PAIM_CHECK(layout.channels == 1 || layout.channels == 3);
}

void CpcaPlayer::decode(double time, const DecodeLimits& limits, TransferLayout& layout,
                        std::vector<float>& transfer) {
    points_.decode(transfer_.matrix, layout_, time, limits, layout, values_);
    table_.assign(values_, transfer_.clusters.scales);
    transfer.resize(size_t{layout.num_planes()} * transfer_.num_vertices());
    sum_all(transfer_.clusters, table_,
            std::min(limits.vertex_components, transfer_.clusters.num_components), transfer);
}

// Rebuilds the pose before it applies the light. With K components over time and C coefficients, a
// row of grey transfer then costs (K + 3) C multiply-adds, and of coloured transfer 3 (K + 1) C.
// With the light first, both would cost 3 (K + 1) C + 3 K. A new light for the same pose costs 3 C.
void CpcaPlayer::basis_radiance(double time, const DecodeLimits& limits,
                                const LightCoefficients& light,
                                std::vector<Vec3f>& basis_radiance) {
    const LowRank& matrix = transfer_.matrix;
    const VertexClusters& clusters = transfer_.clusters;
    const TransferLayout lit = layout_.with_bands(limits.bands);
    const auto num_coefficients = std::min<uint32_t>(
        lit.num_coefficients(), static_cast<uint32_t>(sh::num_coefficients(light.bands)));
    const uint32_t num_components = std::min(limits.transfer_components, matrix.num_components);
    interpolate_weights(matrix, time, weights_);
    PoseRows pose{matrix, std::span(weights_).first(num_components), {}};
    if (time_ != time || limits_ != limits) {
        pose_rows_.clear();
    } else if (pose_rows_.empty()) {
        pose_rows_.resize(matrix.num_rows());
        parallel_for(pose_rows_.size(), kBlock, [&](size_t begin, size_t end) {
            pose.rebuild(begin, std::span(pose_rows_).subspan(begin, end - begin));
        });
    }
    pose.kept = pose_rows_;
    time_ = time;
    limits_ = limits;

    const size_t num_rows = clusters.num_rows();
    basis_radiance.resize(layout_.num_outgoing() * num_rows);
    parallel_for(num_rows, kBlock, [&](size_t begin, size_t end) {
        for (uint32_t o = 0; o < layout_.num_outgoing(); ++o) {
            LitRows rows{pose, layout_.channels, begin, end - begin};
            for (uint32_t channel = 0; channel < layout_.channels; ++channel) {
                for (uint32_t i = 0; i < num_coefficients; ++i) {
                    rows.add(layout_.plane(channel, i, o), channel, light.values[i]);
                }
            }
            Vec3f* const out = basis_radiance.data() + o * num_rows + begin;
            for (size_t j = 0; j < rows.count; ++j) {
                out[j] = clusters.scales[begin + j] *
                         Vec3f(rows.sums[0][j], rows.sums[1][j], rows.sums[2][j]);
            }
        }
    });
    if (limits.vertex_components >= clusters.num_components) return;
    const uint32_t stride = clusters.rows_per_cluster();
    for (size_t r = 0; r < basis_radiance.size(); ++r) {
        if (r % num_rows % stride > limits.vertex_components) basis_radiance[r].setZero();
    }
}

void CpcaPlayer::light(double time, const DecodeLimits& limits, const LightCoefficients& light,
                       const Albedo& albedo, std::vector<Vec3f>& radiance) {
    basis_radiance(time, limits, light, radiance_);
    if (!shading_) shading_.emplace(transfer_.clusters);
    const size_t num_rows = transfer_.clusters.num_rows();
    const size_t num_vertices = transfer_.num_vertices();
    radiance.resize(layout_.num_outgoing() * num_vertices);
    for (size_t o = 0; o < layout_.num_outgoing(); ++o) {
        shading_->shade(std::span(radiance_).subspan(o * num_rows, num_rows),
                        limits.vertex_components, albedo,
                        std::span(radiance).subspan(o * num_vertices, num_vertices));
    }
}

}  // namespace paim
