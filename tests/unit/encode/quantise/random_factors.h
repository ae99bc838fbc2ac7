// ScaledFactors with random components, and slow sums of what matrices decode to.
#pragma once

#include <Eigen/QR>

#include <cmath>

#include "compressor/encode/quantise/scaled_factors.h"
#include "paim/base/seed.h"
#include "paim/codec/asset.h"
#include "paim/codec/component_planes.h"
#include "paim/codec/svd/svd_transfer.h"

namespace paim {

struct FactorsShape {
    uint32_t num_points = 400;
    uint32_t num_planes = 4;
    uint32_t num_poses = 12;
    std::vector<double> sizes{1.0, 0.5, 0.25};  // largest value of each component
};

// Values are uniform in ± the size of their component; the mean has ± 1.
inline ScaledFactors random_factors(const FactorsShape& shape = {}) {
    RandomStream random(3);
    const auto number = [&](double size) {
        return static_cast<float>(size * (2.0 * random.uniform() - 1.0));
    };
    ScaledFactors factors;
    factors.num_points = shape.num_points;
    factors.num_planes = shape.num_planes;
    const size_t num_rows = size_t{shape.num_points} * shape.num_planes;
    for (size_t r = 0; r < num_rows; ++r) factors.mean.push_back(number(1.0));
    for (const double size : shape.sizes) {
        auto& component = factors.components.emplace_back();
        for (size_t r = 0; r < num_rows; ++r) component.push_back(number(size));
    }
    // Orthogonal to the constant and to each other, of unit RMS.
    const auto num_poses = static_cast<Eigen::Index>(shape.num_poses);
    const auto count = static_cast<Eigen::Index>(shape.sizes.size());
    Eigen::MatrixXd columns(num_poses, 1 + count);
    for (double& x : columns.reshaped()) x = random.uniform() - 0.5;
    columns.col(0).setOnes();
    const Eigen::MatrixXd q = Eigen::HouseholderQR<Eigen::MatrixXd>(columns).householderQ() *
                              Eigen::MatrixXd::Identity(num_poses, 1 + count);
    factors.weights = std::sqrt(shape.num_poses) * q.rightCols(count).transpose();
    for (const double size : shape.sizes) factors.singular_values.push_back(size);
    return factors;
}

// One plane over all poses, [N][P].
inline Eigen::MatrixXd exact_plane(const ScaledFactors& factors, uint32_t j) {
    const auto column = [&](const std::vector<float>& values) {
        return Eigen::Map<const Eigen::VectorXf>(factors.plane(values, j).data(),
                                                 factors.num_points)
            .cast<double>();
    };
    Eigen::MatrixXd plane = column(factors.mean) * Eigen::RowVectorXd::Ones(factors.weights.cols());
    for (uint32_t k = 0; k < factors.num_components(); ++k) {
        plane += column(factors.components[k]) * factors.weights.row(k);
    }
    return plane;
}

// Weighted squared error of the decoded transfer of a mesh against the factors.
inline double decoded_error(const CodedMesh& mesh, const ScaledFactors& factors,
                            const std::vector<double>& plane_weight) {
    double sum = 0.0;
    for (uint32_t j = 0; j < factors.num_planes; ++j) {
        const Eigen::MatrixXd decoded = decode_plane(mesh, Attribute::transfer, j).cast<double>();
        sum += plane_weight[j] * (decoded - exact_plane(factors, j)).squaredNorm();
    }
    return sum;
}

// A mesh that holds this transfer and nothing else.
inline CodedMesh mesh_of(CodedTransfer transfer, uint32_t num_vertices) {
    CodedMesh mesh;
    mesh.topology.num_vertices = num_vertices;
    mesh.transfer = std::move(transfer);
    return mesh;
}

}  // namespace paim
