// Multiply-adds that lit transfer takes a vertex and frame, under light of three colours.
#pragma once

#include <cstdint>

#include "paim/codec/model.h"
#include "paim/metrics/rates.h"

namespace paim {

inline uint32_t svd_cost(const TransferLayout& layout, uint32_t num_components) {
    return static_cast<uint32_t>(svd_transfer_cost(layout, num_components, true).per_vertex());
}

inline uint32_t cpca_cost(const TransferLayout& layout, uint32_t num_clusters,
                          uint32_t num_components) {
    return static_cast<uint32_t>(
        clustered_transfer_cost(layout, num_clusters, num_components, 0, true).per_vertex());
}

inline uint32_t transfer_cost(const Model& model) {
    const VertexClusters& clusters = model.clusters;
    return clusters.empty()
               ? svd_cost(model.layout, model.transfer.num_components)
               : cpca_cost(model.layout, clusters.num_clusters, clusters.num_components);
}

}  // namespace paim
