// Counting bytes and multiply-adds.
#include "player/render/cost.h"

#include <algorithm>

#include "paim/metrics/rates.h"

namespace paim::player {

namespace {

// Half floats are floats in memory, but not in the file.
uint64_t value_bytes(const StoredValues& values, Precision precision) {
    if (!values.holds_floats()) return values.holds_i8() ? 1 : 2;
    return precision == Precision::f16 ? 2 : 4;
}

uint64_t part_bytes(const LowRankMatrix& matrix, uint64_t planes, uint32_t num_components) {
    uint64_t row_bytes = value_bytes(matrix.mean, Precision::f32);  // halves have means of floats
    for (uint32_t k = 0; k < num_components; ++k) {
        row_bytes += value_bytes(matrix.components[k], matrix.precision);
    }
    return row_bytes * planes * matrix.num_points +
           (matrix.steps.empty() ? 0 : sizeof(float) * planes) +
           sizeof(float) * uint64_t{num_components} * matrix.num_poses;
}

uint64_t cluster_bytes(const VertexClusters& clusters, uint32_t num_components) {
    uint64_t vertex_bytes = sizeof(uint16_t);  // of the index
    for (uint32_t j = 0; j < num_components; ++j) {
        vertex_bytes += value_bytes(clusters.coefficients[j], Precision::f32);
    }
    return vertex_bytes * clusters.cluster.size() +
           sizeof(float) * uint64_t{clusters.num_clusters} * (num_components + 1);
}

}  // namespace

Cost frame_cost(const Model& model, const DecodeLimits& limits) {
    Cost cost{};
    cost.geometry_components = std::min(limits.geometry_components, model.geometry.num_components);
    cost.transfer_components = std::min(limits.transfer_components, model.transfer.num_components);
    cost.cluster_components = std::min(limits.cluster_components, model.clusters.num_components);
    cost.bands = std::min(limits.bands, model.layout.bands);
    TransferLayout layout = model.layout;
    layout.bands = cost.bands;
    cost.bytes = part_bytes(model.geometry, 3, cost.geometry_components) +
                 part_bytes(model.transfer, layout.num_planes(), cost.transfer_components);
    cost.multiply_adds = svd_geometry_cost(cost.geometry_components).per_vertex();
    if (model.clusters.empty()) {
        cost.multiply_adds +=
            svd_transfer_cost(layout, cost.transfer_components, true).per_vertex();
        return cost;
    }
    const auto of_clusters = [&](uint32_t num_components) {
        return clustered_transfer_cost(layout, model.clusters.num_clusters, num_components,
                                       cost.transfer_components, true);
    };
    cost.bytes += cluster_bytes(model.clusters, cost.cluster_components);
    cost.multiply_adds += of_clusters(cost.cluster_components).per_vertex();
    // All components of the bases are lit, even where vertices use fewer.
    cost.cluster_multiply_adds = of_clusters(model.clusters.num_components).cpu_per_frame;
    return cost;
}

}  // namespace paim::player
