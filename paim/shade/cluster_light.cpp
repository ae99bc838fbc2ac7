// Pose, then light, then vertices.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "paim/shade/cluster_light.h"

#include <algorithm>
#include <array>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/accumulate.h"
#include "paim/codec/basis_table.h"
#include "paim/codec/low_rank.h"

namespace paim {

namespace {

constexpr size_t kBlock = 512;  // rows whose planes and sums stay in the first cache
using Plane = std::array<float, kBlock>;

// What some rows show under a light, plane by plane.
struct RowBlockLight {
    const Model& model;
    std::span<const float> weights;  // of the components in use
    size_t first = 0;
    size_t count = 0;
    Plane plane = {};
    std::array<Plane, 3> sums = {};

    // Of grey transfer to all channels.
    void add(uint32_t plane_index, uint32_t channel, const Vec3f& incident) {
        const LowRankMatrix& matrix = model.transfer;
        accumulate(matrix.mean, std::span(matrix.components).first(weights.size()), weights, 1.0f,
                   size_t{plane_index} * matrix.num_points + first, std::span(plane).first(count));
        const Vec3f light = matrix.step(plane_index) * incident;
        if (model.layout.channels == 3) {
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

ClusterLight::ClusterLight(const Model& model) : model_(model) {
    PAIM_CHECK(!model.clusters.empty());
    PAIM_CHECK_EQ(model.transfer.num_points, model.clusters.num_rows());
}

// The pose comes first. With K components over time and C coefficients, a row of grey transfer then
// costs (K + 3) C multiply-adds, of coloured transfer 3 (K + 1) C; with the light first, both cost
// 3 (K + 1) C + 3 K.
void ClusterLight::basis_radiance(double time, const DecodeLimits& limits,
                                  const LightCoefficients& light, std::vector<Vec3f>& products) {
    const TransferLayout& layout = model_.layout;
    const VertexClusters& clusters = model_.clusters;
    PAIM_CHECK(layout.channels == 1 || layout.channels == 3);
    const uint32_t bands =
        std::min(std::clamp(limits.bands, 1u, layout.bands), static_cast<uint32_t>(light.bands));
    const uint32_t num_components =
        std::min(limits.transfer_components, model_.transfer.num_components);
    interpolate_weights(model_.transfer, time, weights_);
    const std::span<const float> weights = std::span(weights_).first(num_components);
    products.resize(clusters.num_rows());
    parallel_for(products.size(), kBlock, [&](size_t begin, size_t end) {
        RowBlockLight block{model_, weights, begin, end - begin};
        for (uint32_t channel = 0; channel < layout.channels; ++channel) {
            for (uint32_t i = 0; i < bands * bands; ++i) {
                block.add(layout.plane(channel, i), channel, light.values[i]);
            }
        }
        for (size_t j = 0; j < block.count; ++j) {
            products[begin + j] = clusters.scales[begin + j] *
                                  Vec3f(block.sums[0][j], block.sums[1][j], block.sums[2][j]);
        }
    });
    if (limits.cluster_components >= clusters.num_components) return;
    const uint32_t stride = clusters.rows_per_cluster();
    for (size_t r = 0; r < products.size(); ++r) {
        if (r % stride > limits.cluster_components) products[r].setZero();
    }
}

void shade_clusters(const VertexClusters& clusters, std::span<const Vec3f> products,
                    uint32_t num_components, const Albedo& albedo, std::vector<Vec3f>& radiance) {
    PAIM_CHECK_EQ(products.size(), size_t{clusters.num_rows()});
    const uint32_t used = std::min(num_components, clusters.num_components);
    BasisTable table;
    table.assign(products);
    const BasisSum combination{table, clusters.cluster,
                               std::span(clusters.coefficients).first(used),
                               clusters.rows_per_cluster()};
    radiance.resize(clusters.cluster.size());
    constexpr size_t kVerticesATask = 4096;
    parallel_for(radiance.size(), kVerticesATask, [&](size_t begin, size_t end) {
        constexpr size_t kVerticesATime = 128;  // their sums stay in the first cache
        std::array<float, kVerticesATime * BasisTable::kNarrow> sums;
        for (size_t first = begin; first < end; first += kVerticesATime) {
            const size_t count = std::min(kVerticesATime, end - first);
            weighted_sum_by_vertex(combination, first, count,
                                   std::span(sums).first(count * BasisTable::kNarrow));
            for (size_t j = 0; j < count; ++j) {
                const Eigen::Map<const Vec3f> sum(sums.data() + j * BasisTable::kNarrow);
                radiance[first + j] = sum.cwiseProduct(albedo.at(static_cast<uint32_t>(first + j)));
            }
        }
    });
}

}  // namespace paim
