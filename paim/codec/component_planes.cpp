// Planes of a decoded animation over all of its poses.
#include "paim/codec/component_planes.h"

#include "paim/codec/rebuild_planes.h"

namespace paim {

Eigen::MatrixXf decode_plane(const CodedMesh& mesh, Attribute attribute, uint32_t plane) {
    const Eigen::MatrixXf points = rebuild_sequence(mesh.attribute(attribute), plane);
    const TransferModel& transfer = *mesh.transfer;
    if (attribute == Attribute::geometry || transfer.points_are_vertices()) return points;
    const uint32_t num_vertices = mesh.topology.num_vertices;
    Eigen::MatrixXf vertices(static_cast<Eigen::Index>(num_vertices), points.cols());
    for (Eigen::Index p = 0; p < points.cols(); ++p) {
        transfer.vertices_from_points(
            std::span(points.col(p).data(), static_cast<size_t>(points.rows())),
            transfer.num_vertex_components(), std::span(vertices.col(p).data(), num_vertices));
    }
    return vertices;
}

}  // namespace paim
