// The decoder of clustered PCA.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#include "paim/codec/cluster_decoder.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/codec/pose_parts.h"

namespace paim {

void combine_rows(const VertexClusters& clusters, std::span<const float> rows,
                  uint32_t num_components, std::span<float> out) {
    const uint32_t stride = clusters.rows_per_cluster();
    std::vector<float> scaled(rows.size());
    for (size_t r = 0; r < rows.size(); ++r) scaled[r] = clusters.scales[r] * rows[r];
    for (size_t v = 0; v < out.size(); ++v) out[v] = scaled[clusters.cluster[v] * stride];
    for (uint32_t j = 0; j < num_components; ++j) {
        clusters.coefficients[j].for_each(0, out.size(), [&](size_t v, float coefficient) {
            out[v] += coefficient * scaled[clusters.cluster[v] * stride + 1 + j];
        });
    }
}

ClusterDecoder::ClusterDecoder(const Model& model) : model_(model) {
    PAIM_CHECK(!model.clusters.empty());
    PAIM_CHECK_EQ(model.transfer.num_points, model.clusters.num_rows());
}

void ClusterDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) const {
    decode_positions(model_, time, limits, out);
    std::vector<float> rows;
    decode_transfer_points(model_, time, limits, out.layout, rows);
    const size_t num_rows = model_.transfer.num_points;
    const size_t num_vertices = model_.topology.num_vertices;
    const uint32_t num_components =
        std::min(limits.cluster_components, model_.clusters.num_components);
    out.transfer.resize(size_t{out.layout.num_planes()} * num_vertices);
    parallel_for(out.layout.num_planes(), 1, [&](size_t plane, size_t) {
        combine_rows(model_.clusters, std::span(rows).subspan(plane * num_rows, num_rows),
                     num_components,
                     std::span(out.transfer).subspan(plane * num_vertices, num_vertices));
    });
}

}  // namespace paim
