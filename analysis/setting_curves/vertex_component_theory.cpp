// What dropping the last components of every vertex should cost.
#include "analysis/setting_curves/vertex_component_theory.h"

#include <Eigen/Core>

#include <cmath>

#include "paim/codec/point_groups.h"

namespace paim {

using Eigen::Index;

namespace {

// [points] Sum of squares of a point's values over planes and poses.
Eigen::VectorXd point_energies(const LowRank& matrix) {
    const auto num_points = static_cast<Index>(matrix.num_points);
    const auto num_columns = static_cast<Index>(matrix.num_components) + 1;
    // The mean's weight is 1 in every pose.
    Eigen::MatrixXd weights = Eigen::MatrixXd::Ones(num_columns, matrix.num_poses);
    for (Index k = 0; k + 1 < num_columns; ++k) {
        for (Index p = 0; p < weights.cols(); ++p) {
            weights(k + 1, p) = matrix.weights[static_cast<size_t>(k * weights.cols() + p)];
        }
    }
    const Eigen::MatrixXd gram = weights * weights.transpose();
    Eigen::VectorXd energies = Eigen::VectorXd::Zero(num_points);
    Eigen::MatrixXf values(num_points, num_columns);
    for (uint32_t plane = 0; plane < matrix.num_planes; ++plane) {
        const size_t first = size_t{plane} * matrix.num_points;
        for (Index k = 0; k < num_columns; ++k) {
            const StoredValues& stored =
                k == 0 ? matrix.mean : matrix.components[static_cast<size_t>(k) - 1];
            stored.widen(first, {values.col(k).data(), matrix.num_points});
        }
        const Eigen::MatrixXd scaled = matrix.step(plane) * values.cast<double>();
        energies += (scaled * gram).cwiseProduct(scaled).rowwise().sum();
    }
    return energies;
}

}  // namespace

VertexComponentSpectrum vertex_component_spectrum(const TransferModel& transfer) {
    const std::optional<PointGroups> groups = transfer.point_groups();
    const auto num_components = static_cast<Index>(transfer.num_vertex_components());
    if (!groups || num_components == 0) return {};
    const Index num_rows = groups->factors.cols(), first = groups->is_affine ? 1 : 0;
    if (num_rows - first != num_components) return {};
    const Eigen::VectorXd energies = point_energies(transfer.matrix);
    Eigen::MatrixXd squares = Eigen::MatrixXd::Zero(groups->num_groups, num_components);
    for (size_t v = 0; v < groups->group.size(); ++v) {
        squares.row(groups->group[v]) += groups->factors.row(static_cast<Index>(v))
                                             .rightCols(num_components)
                                             .cast<double>()
                                             .cwiseAbs2();
    }
    VertexComponentSpectrum spectrum;
    for (Index j = 0; j < num_components; ++j) {
        double sum = 0.0, sum_of_squares = 0.0;
        for (Index g = 0; g < squares.rows(); ++g) {
            const double energy = squares(g, j) * energies[g * num_rows + first + j];
            sum += std::sqrt(energy);
            sum_of_squares += energy;
        }
        spectrum.sum.push_back(sum);
        spectrum.root.push_back(std::sqrt(sum_of_squares));
    }
    return spectrum;
}

}  // namespace paim
