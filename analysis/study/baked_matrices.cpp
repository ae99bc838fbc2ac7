// Bakes a sequence into memory.
#include "analysis/study/baked_matrices.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "compressor/bake/transfer_baker.h"
#include "paim/base/check.h"

namespace paim::study {

namespace {

using Eigen::Index;
using Eigen::MatrixXf;

// Σ over all entries of (a − b)², column by column in double.
double squared_distance(const MatrixXf& a, const MatrixXf& b) {
    double sum = 0.0;
    for (Index p = 0; p < a.cols(); ++p) {
        sum += (a.col(p).cast<double>() - b.col(p).cast<double>()).squaredNorm();
    }
    return sum;
}

MatrixXf changes(const MatrixXf& matrix) {
    return matrix.rightCols(matrix.cols() - 1) - matrix.leftCols(matrix.cols() - 1);
}

double energy(const MatrixXf& matrix) {
    return squared_distance(matrix, MatrixXf::Zero(matrix.rows(), matrix.cols()));
}

}  // namespace

BakedMatrices bake_matrices(const PoseSource& source, const BakeOptions& options,
                            uint32_t num_poses) {
    PAIM_CHECK_LE(num_poses, source.num_poses());
    const TransferBaker baker(options);
    const Index rows = static_cast<Index>(baker.layout().num_planes()) *
                       static_cast<Index>(source.topology().num_vertices);
    BakedMatrices result;
    result.transfer.resize(rows, static_cast<Index>(num_poses));
    result.noise.resize(rows, static_cast<Index>(num_poses));
    for (uint32_t p = 0; p < num_poses; ++p) {
        const BakedPose pose = baker.bake(source.topology(), source.load_pose(p), p);
        const auto column = static_cast<Index>(p);
        result.transfer.col(column) = Eigen::Map<const Eigen::VectorXf>(pose.transfer.data(), rows);
        result.noise.col(column) = Eigen::Map<const Eigen::VectorXf>(pose.noise.data(), rows);
        result.num_rays += pose.statistics.rays;
    }
    return result;
}

Truth::Truth(BakedMatrices truth)
    : truth_(std::move(truth)),
      noise_energy_(energy(truth_.noise)),
      change_noise_(energy(changes(truth_.noise))) {
    energy_ = energy(truth_.transfer) - noise_energy_;
    change_energy_ = energy(changes(truth_.transfer)) - change_noise_;
}

double Truth::error(const MatrixXf& approximation) const {
    const double squared = squared_distance(approximation, truth_.transfer) - noise_energy_;
    return std::sqrt(std::max(0.0, squared) / energy_);
}

double Truth::vertex_error(const MatrixXf& approximation, uint32_t num_vertices,
                           double share) const {
    const auto vertices = static_cast<Index>(num_vertices);
    std::vector<double> errors;
    for (Index p = 0; p < approximation.cols(); ++p) {
        const Eigen::VectorXf column = approximation.col(p) - truth_.transfer.col(p);
        for (Index v = 0; v < vertices; ++v) {
            const Eigen::Map<const Eigen::VectorXf, 0, Eigen::InnerStride<>> of_vertex(
                column.data() + v, column.size() / vertices, Eigen::InnerStride<>(vertices));
            errors.push_back(static_cast<double>(of_vertex.norm()));
        }
    }
    const auto at = std::min(errors.size() - 1,
                             static_cast<size_t>(share * static_cast<double>(errors.size())));
    std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(at),
                     errors.end());
    return errors[at];
}

double Truth::flicker(const MatrixXf& approximation) const {
    const double squared =
        squared_distance(changes(approximation), changes(truth_.transfer)) - change_noise_;
    return std::sqrt(std::max(0.0, squared) / change_energy_);
}

}  // namespace paim::study
