// The decoder of clustered PCA.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "paim/codec/cluster_decoder.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/pose_parts.h"

namespace paim {

namespace {

// out[plane][v], all planes of the table
void combine_all(const VertexClusters& clusters, const BasisTable& table, uint32_t num_components,
                 std::span<float> out) {
    constexpr size_t kVerticesATask = 1024;
    const BasisSum combination{table, clusters.cluster,
                               std::span(clusters.coefficients).first(num_components),
                               clusters.rows_per_cluster()};
    parallel_for(clusters.cluster.size(), kVerticesATask, [&](size_t begin, size_t end) {
        weighted_sum(combination, begin, end - begin, out);
    });
}

}  // namespace

void combine_rows(const VertexClusters& clusters, std::span<const float> rows,
                  uint32_t num_components, std::span<float> out) {
    BasisTable table;
    table.assign(rows, clusters.scales);
    combine_all(clusters, table, num_components, out);
}

ClusterDecoder::ClusterDecoder(const Model& model) : model_(model) {
    PAIM_CHECK(!model.clusters.empty());
    PAIM_CHECK_EQ(model.transfer.num_points, model.clusters.num_rows());
}

void ClusterDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) const {
    decode_positions(model_, time, limits, out);
    decode_transfer_points(model_, time, limits, out.layout, out.basis_rows);
    out.row_table.assign(out.basis_rows, model_.clusters.scales);
    out.transfer.resize(size_t{out.layout.num_planes()} * model_.topology.num_vertices);
    combine_all(model_.clusters, out.row_table,
                std::min(limits.cluster_components, model_.clusters.num_components), out.transfer);
}

}  // namespace paim
