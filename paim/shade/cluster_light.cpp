// Pose, then light, then vertices.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "paim/shade/cluster_light.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/accumulate.h"
#include "paim/codec/low_rank.h"

namespace paim {

ClusterLight::ClusterLight(const Model& model) : model_(model) {
    PAIM_CHECK(!model.clusters.empty());
    PAIM_CHECK_EQ(model.transfer.num_points, model.clusters.num_rows());
}

// The pose comes first. With K components over time and C coefficients, a row of grey transfer then
// costs (K + 3) C multiply-adds, of coloured transfer 3 (K + 1) C; with the light first, both cost
// 3 (K + 1) C + 3 K.
void ClusterLight::light_products(double time, const DecodeLimits& limits,
                                  const LightCoefficients& light, std::vector<Vec3f>& products) {
    const TransferLayout& layout = model_.layout;
    const VertexClusters& clusters = model_.clusters;
    PAIM_CHECK(layout.channels == 1 || layout.channels == 3);
    const uint32_t bands =
        std::min(std::clamp(limits.bands, 1u, layout.bands), static_cast<uint32_t>(light.bands));
    const uint32_t num_components =
        std::min(limits.transfer_components, model_.transfer.num_components);
    interpolate_weights(model_.transfer, time, weights_);
    products.resize(clusters.num_rows());
    for (size_t first = 0; first < products.size(); first += kBlock) {
        const size_t count = std::min(kBlock, products.size() - first);
        for (Plane& sum : sums_) sum.fill(0.0f);
        for (uint32_t channel = 0; channel < layout.channels; ++channel) {
            for (uint32_t i = 0; i < bands * bands; ++i) {
                add_plane(layout.plane(channel, i), channel, light.values[i], first, count,
                          num_components);
            }
        }
        for (size_t j = 0; j < count; ++j) {
            products[first + j] =
                clusters.scales[first + j] * Vec3f(sums_[0][j], sums_[1][j], sums_[2][j]);
        }
    }
    if (limits.cluster_components >= clusters.num_components) return;
    const uint32_t stride = clusters.rows_per_cluster();
    for (size_t r = 0; r < products.size(); ++r) {
        if (r % stride > limits.cluster_components) products[r].setZero();
    }
}

// Rebuilds rows of a plane and adds what they show: of grey transfer to all channels.
void ClusterLight::add_plane(uint32_t plane, uint32_t channel, const Vec3f& incident,
                             size_t first_row, size_t num_rows, uint32_t num_components) {
    const LowRankMatrix& matrix = model_.transfer;
    const size_t first = size_t{plane} * matrix.num_points + first_row;
    const std::span<float> values = std::span(plane_).first(num_rows);
    accumulate(matrix.mean, std::span(matrix.components).first(num_components),
               std::span(weights_).first(num_components), 1.0f, first, values);
    const Vec3f light = matrix.step(plane) * incident;
    if (model_.layout.channels == 3) {
        Plane& sum = sums_[channel];
        for (size_t j = 0; j < num_rows; ++j) sum[j] += light[channel] * plane_[j];
        return;
    }
    for (size_t j = 0; j < num_rows; ++j) {
        sums_[0][j] += light[0] * plane_[j];
        sums_[1][j] += light[1] * plane_[j];
        sums_[2][j] += light[2] * plane_[j];
    }
}

void shade_clusters(const VertexClusters& clusters, std::span<const Vec3f> products,
                    uint32_t num_components, const Albedo& albedo, std::vector<Vec3f>& radiance) {
    PAIM_CHECK_EQ(products.size(), size_t{clusters.num_rows()});
    constexpr size_t kGrain = 1024;  // vertices whose sums stay in the first cache
    const uint32_t stride = clusters.rows_per_cluster();
    const uint32_t used = std::min(num_components, clusters.num_components);
    radiance.resize(clusters.cluster.size());
    parallel_for(radiance.size(), kGrain, [&](size_t begin, size_t end) {
        for (size_t v = begin; v < end; ++v) {
            radiance[v] = products[size_t{clusters.cluster[v]} * stride];
        }
        for (uint32_t j = 0; j < used; ++j) {
            clusters.coefficients[j].for_each(begin, end - begin, [&](size_t v, float coefficient) {
                radiance[v] += coefficient * products[size_t{clusters.cluster[v]} * stride + 1 + j];
            });
        }
        for (size_t v = begin; v < end; ++v) {
            radiance[v] = radiance[v].cwiseProduct(albedo.at(static_cast<uint32_t>(v)));
        }
    });
}

}  // namespace paim
