// Planes of a decoded animation over all of its poses.
#include "paim/codec/component_planes.h"

#include "paim/codec/cluster_decoder.h"
#include "paim/codec/low_rank.h"

namespace paim {

Eigen::MatrixXf decode_plane(const Model& model, Attribute attribute, uint32_t plane) {
    const Eigen::MatrixXf points = rebuild_sequence(model.attribute(attribute), plane);
    if (attribute == Attribute::geometry || model.clusters.empty()) return points;
    const uint32_t num_vertices = model.topology.num_vertices;
    Eigen::MatrixXf vertices(static_cast<Eigen::Index>(num_vertices), points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
        combine_rows(
            model.clusters, std::span(points.col(p).data(), static_cast<size_t>(points.rows())),
            model.clusters.num_components, std::span(vertices.col(p).data(), num_vertices));
    }
    return vertices;
}

}  // namespace paim
