// How much of the motion of every vertex a file keeps.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "paim/codec/rebuild_planes.h"
#include "paim/format/bake/baked_part.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/geometry_error.h"
#include "paim/metrics/vertex_match.h"

namespace paim {

// Of the vertex that loses most.
struct KeptMotion {
    // Its motion within the mesh (compressor/encode/svd/vertex_motion.h), decoded by baked.
    double share = std::numeric_limits<double>::infinity();
    uint32_t vertex = 0;
    double baked = 0.0;  // RMS, scene units
};

// Largest diagonal of a pose of a bake without isolated vertices and outliers.
inline double diagonal_of(const BakeReader& bake) {
    GeometryError error;
    std::vector<float> planes(size_t{3} * bake.identity().num_vertices);
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        bake.read_position_rows(p, 0, planes.size(), planes.data());
        error.add(planes, planes, p);
    }
    return error.diagonal;
}

// Over the vertices that a face has and whose baked motion is more than `least`, scene units.
inline KeptMotion least_kept_motion(const Asset& asset, const BakeReader& bake, double least) {
    const CodedMesh& mesh = asset.moving();
    const uint32_t num_vertices = mesh.topology.num_vertices;
    const auto num_poses = static_cast<Eigen::Index>(bake.num_poses());
    const std::vector<uint32_t> old_vertex =
        match_vertices(mesh.topology, asset.vertex_order, bake.topology(), "bake", "triangles");
    const std::vector<uint32_t> vertices = face_vertices(mesh.topology);
    Eigen::MatrixXf decoded(3 * Eigen::Index{num_vertices}, num_poses), baked(decoded);
    PositionDecoder decoder;
    std::vector<float> planes;
    for (Eigen::Index p = 0; p < num_poses; ++p) {
        const auto pose = static_cast<uint32_t>(p);
        decoder.decode(mesh.positions, pose, mesh.positions.num_components, planes);
        std::copy(planes.begin(), planes.end(), decoded.col(p).begin());
        bake.read_position_rows(pose, 0, planes.size(), planes.data());
        reorder_planes(planes, old_vertex);
        std::copy(planes.begin(), planes.end(), baked.col(p).begin());
    }
    // Squared, [vertices]
    const auto motion = [&](const Eigen::MatrixXf& positions) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(vertices.size()));
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            Eigen::MatrixXd plane =
                positions.middleRows(axis * num_vertices, num_vertices)(vertices, Eigen::all)
                    .cast<double>();
            plane.rowwise() -= plane.colwise().mean().eval();
            plane.colwise() -= plane.rowwise().mean().eval();
            sum += plane.rowwise().squaredNorm();
        }
        return Eigen::VectorXd(sum / static_cast<double>(num_poses));
    };
    const Eigen::VectorXd of_decoded = motion(decoded), of_baked = motion(baked);
    KeptMotion kept;
    for (Eigen::Index j = 0; j < of_baked.size(); ++j) {
        if (!(of_baked[j] > least * least)) continue;
        const double share = std::sqrt(of_decoded[j] / of_baked[j]);
        if (!(share < kept.share)) continue;
        kept = {share, vertices[static_cast<size_t>(j)], std::sqrt(of_baked[j])};
    }
    return kept;
}

}  // namespace paim
