// Errors of a decoded transfer to the bake, and expected errors to the truth.
// Based on: Efron 2004 (see the header)
#include "paim/metrics/transfer_error.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "paim/base/check.h"
#include "paim/base/parallel.h"
#include "paim/metrics/missing_bands.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kRowsAtOnce = 256;
constexpr Index kBlocksAtOnce = 64;

double root_ratio(double part, double whole) {
    if (whole > 0.0) return std::sqrt(part / whole);
    return part > 0.0 ? std::numeric_limits<double>::infinity() : std::sqrt(part);
}

// Index of the largest value, the first of equal ones. NaN counts as larger than any number.
template <typename Values>
size_t find_worst(const Values& values) {
    size_t worst = 0;
    for (size_t j = 1; j < static_cast<size_t>(values.size()); ++j) {
        if (!(values[j] <= values[worst])) worst = j;
        if (std::isnan(values[worst])) break;
    }
    return worst;
}

const MatrixXd& checked(const MatrixXd& span, uint32_t num_poses) {
    PAIM_CHECK_EQ(span.rows(), static_cast<Index>(num_poses));
    PAIM_CHECK(span.cols() >= 1 && span.cols() <= span.rows());
    // Far below any error that is measured.
    constexpr double kRounding = 1e-9;
    const VectorXd constant = VectorXd::Constant(span.rows(), 1.0 / std::sqrt(num_poses));
    const MatrixXd identity = MatrixXd::Identity(span.cols(), span.cols());
    PAIM_CHECK_LT((span.col(0) - constant).cwiseAbs().maxCoeff(), kRounding);
    PAIM_CHECK_LT((span.transpose() * span - identity).cwiseAbs().maxCoeff(), kRounding);
    return span;
}

}  // namespace

TransferErrorMeter::TransferErrorMeter(const TransferLayout& layout, uint32_t num_vertices,
                                       uint32_t num_poses, BandPower spectrum, const MatrixXd& span,
                                       std::optional<DecodedPoints> points)
    : layout_(layout),
      num_vertices_(static_cast<Index>(num_vertices)),
      num_poses_(static_cast<Index>(num_poses)),
      spectrum_(std::move(spectrum)),
      covariance_(layout, num_vertices, spectrum_, checked(span, num_poses), std::move(points)),
      surveyed_(layout.num_planes(), false),
      added_(layout.num_planes(), false),
      energy_(layout.in_bands),
      vertex_error_to_bake_(num_vertices, 0.0),
      pose_error_to_bake_(VectorXd::Zero(num_poses_)) {
    PAIM_CHECK_LE(1u, num_vertices);
    PAIM_CHECK_LE(1u, num_poses);
    PAIM_CHECK_LE(1u, layout.in_bands);
}

TransferErrorMeter::RowSums TransferErrorMeter::measure_rows(Index first, Index count,
                                                             double weight, const Plane& baked,
                                                             const Plane& noise,
                                                             const Plane& decoded) {
    RowSums sums{{}, VectorXd(num_poses_)};
    VectorXd row_error = VectorXd::Zero(count);
    for (Index p = 0; p < num_poses_; ++p) {
        const auto column = [&](const Plane& values) {
            return values.col(p).segment(first, count).cast<double>();
        };
        const VectorXd error = (column(decoded) - column(baked)).cwiseAbs2();
        row_error += error;
        sums.pose_error_to_bake(p) = error.sum();
        // Added in the same order, so that a decoder of nothing errs by exactly what is there.
        const VectorXd energy = column(baked).cwiseAbs2();
        sums.energy.error_to_bake += error.sum();
        sums.energy.baked += energy.sum();
        sums.energy.noise += column(noise).squaredNorm();
    }
    for (Index row = 0; row < count; ++row) {
        vertex_error_to_bake_[static_cast<size_t>(first + row)] += weight * row_error(row);
    }
    return sums;
}

void TransferErrorMeter::check_shapes(std::initializer_list<const Plane*> planes) const {
    for (const Plane* const plane : planes) {
        PAIM_CHECK_EQ(plane->rows(), num_vertices_);
        PAIM_CHECK_EQ(plane->cols(), num_poses_);
    }
}

void TransferErrorMeter::survey(uint32_t plane, const Plane& baked, const Plane& noise) {
    PAIM_CHECK_LT(plane, layout_.num_planes());
    PAIM_CHECK(!surveyed_[plane]);
    check_shapes({&baked, &noise});
    surveyed_[plane] = true;
    covariance_.survey(plane, baked, noise);
}

void TransferErrorMeter::add(uint32_t plane, const Plane& baked, const Plane& noise,
                             const Plane& decoded) {
    PAIM_CHECK_LT(plane, layout_.num_planes());
    PAIM_CHECK(!added_[plane]);
    check_shapes({&baked, &noise, &decoded});
    added_[plane] = true;
    covariance_.add(plane, baked, noise, decoded);
    const uint32_t band = layout_.input_band(plane);
    const double weight = spectrum_.weight(band);
    const Index num_blocks = (num_vertices_ + kRowsAtOnce - 1) / kRowsAtOnce;
    for (Index round = 0; round < num_blocks; round += kBlocksAtOnce) {
        std::vector<RowSums> blocks(
            static_cast<size_t>(std::min(kBlocksAtOnce, num_blocks - round)));
        parallel_for(blocks.size(), 1, [&](size_t j, size_t) {
            const Index first = (round + static_cast<Index>(j)) * kRowsAtOnce;
            blocks[j] = measure_rows(first, std::min(kRowsAtOnce, num_vertices_ - first), weight,
                                     baked, noise, decoded);
        });
        for (const RowSums& block : blocks) {
            energy_[band].baked += block.energy.baked;
            energy_[band].noise += block.energy.noise;
            energy_[band].error_to_bake += block.energy.error_to_bake;
            pose_error_to_bake_ += weight * block.pose_error_to_bake;
        }
    }
}

uint64_t TransferErrorMeter::bytes(uint64_t num_vertices, uint64_t num_poses, uint64_t span_size,
                                   uint64_t num_points, uint64_t num_points_each) {
    return (num_vertices + uint64_t{kBlocksAtOnce} * num_poses) * sizeof(double) +
           NoiseCovariance::bytes(num_vertices, span_size, num_points, num_points_each);
}

TransferError TransferErrorMeter::result() const {
    PAIM_CHECK(std::find(added_.begin(), added_.end(), false) == added_.end());
    TransferError result;
    result.bands = energy_;
    double baked = 0.0, noise = 0.0, error_to_bake = 0.0, expected = 0.0;
    std::vector<double> true_energy;
    const std::vector<double> covariance = covariance_.result();
    for (uint32_t l = 0; l < layout_.in_bands; ++l) {
        TransferBandEnergy& band = result.bands[l];
        band.noise_covariance = covariance[l];
        const double weight = spectrum_.weight(l);
        baked += weight * band.baked;
        noise += weight * band.noise;
        error_to_bake += weight * band.error_to_bake;
        expected += weight * band.expected();
        true_energy.push_back(std::max(0.0, band.baked - band.noise));
    }
    result.error_to_bake = root_ratio(error_to_bake, baked);
    result.bake_noise = root_ratio(noise, baked);
    result.error = root_ratio(expected, baked);

    result.missing_bands = root_ratio(missing_band_energy(true_energy, spectrum_), baked);

    const size_t vertex = find_worst(vertex_error_to_bake_);
    result.worst_vertex = static_cast<uint32_t>(vertex);
    result.worst_vertex_error_to_bake =
        root_ratio(vertex_error_to_bake_[vertex], baked / static_cast<double>(num_vertices_));
    const std::span<const double> poses(pose_error_to_bake_.data(),
                                        static_cast<size_t>(num_poses_));
    const size_t pose = find_worst(poses);
    result.worst_pose = static_cast<uint32_t>(pose);
    result.worst_pose_error_to_bake =
        root_ratio(poses[pose], baked / static_cast<double>(num_poses_));
    return result;
}

}  // namespace paim
