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

// Class of a row by the share g of its movement that the decoder lets through. Classes are steps of
// √2 of the odds g / (1 − g), from 2^-4 to 2^8. The decoder lets noise through by the same shares.
// They are Wiener factors, whose odds are the ratio of signal to noise of a vertex and component.
// decoded, baked  [K' - 1] coordinates of the row along the span without the constant
Index passing_class(const VectorXd& decoded, const VectorXd& baked) {
    const double passing = decoded.dot(baked);
    const double stopped = baked.squaredNorm() - passing;
    if (!(passing > 0.0)) return 0;
    if (!(stopped > 0.0)) return TransferErrorMeter::kNumClasses - 1;
    const double step = 2.0 * (std::log2(passing / stopped) + 4.0);
    return static_cast<Index>(
        std::clamp(step, 0.0, static_cast<double>(TransferErrorMeter::kNumClasses - 1)));
}

}  // namespace

TransferErrorMeter::TransferErrorMeter(const TransferLayout& layout, uint32_t num_vertices,
                                       uint32_t num_poses, BandPower spectrum, MatrixXd span)
    : layout_(layout),
      num_vertices_(static_cast<Index>(num_vertices)),
      num_poses_(static_cast<Index>(num_poses)),
      spectrum_(std::move(spectrum)),
      span_(std::move(span)),
      added_(layout.num_planes(), false),
      energy_(layout.in_bands),
      vertex_error_to_bake_(num_vertices, 0.0),
      pose_error_to_bake_(VectorXd::Zero(num_poses_)) {
    PAIM_CHECK_LE(1u, num_vertices);
    PAIM_CHECK_LE(1u, num_poses);
    PAIM_CHECK_LE(1u, layout.in_bands);
    PAIM_CHECK_EQ(span_.rows(), num_poses_);
    PAIM_CHECK(span_.cols() >= 1 && span_.cols() <= num_poses_);
    // Far below any error that is measured.
    constexpr double kRounding = 1e-9;
    const VectorXd constant = VectorXd::Constant(num_poses_, 1.0 / std::sqrt(num_poses));
    const MatrixXd identity = MatrixXd::Identity(span_.cols(), span_.cols());
    PAIM_CHECK_LT((span_.col(0) - constant).cwiseAbs().maxCoeff(), kRounding);
    PAIM_CHECK_LT((span_.transpose() * span_ - identity).cwiseAbs().maxCoeff(), kRounding);
    directions_.assign(layout.in_bands, zero_sums());
}

TransferErrorMeter::DirectionSums TransferErrorMeter::zero_sums() const {
    const MatrixXd zero = MatrixXd::Zero(span_.cols() + 1, kNumClasses);
    return {zero, zero, zero};
}

void TransferErrorMeter::DirectionSums::add(const DirectionSums& other) {
    decoded_baked += other.decoded_baked;
    baked += other.baked;
    noise += other.noise;
}

TransferErrorMeter::RowSums TransferErrorMeter::measure_rows(Index first, Index count,
                                                             double weight, const Plane& baked,
                                                             const Plane& noise,
                                                             const Plane& decoded) {
    // [P][rows]: each row of the data is a column here, so that both products read contiguous
    // values.
    const MatrixXd x = baked.middleRows(first, count).transpose().cast<double>();
    const MatrixXd d = noise.middleRows(first, count).transpose().cast<double>();
    const MatrixXd x_hat = decoded.middleRows(first, count).transpose().cast<double>();
    const MatrixXd x_along = span_.transpose() * x;
    const MatrixXd d_along = span_.transpose() * d;
    const MatrixXd x_hat_along = span_.transpose() * x_hat;
    const Index size = span_.cols();
    RowSums sums{{}, zero_sums(), (x_hat - x).rowwise().squaredNorm()};
    for (Index row = 0; row < count; ++row) {
        const double row_baked = x.col(row).squaredNorm();
        const double row_noise = d.col(row).squaredNorm();
        const double row_error = (x_hat.col(row) - x.col(row)).squaredNorm();
        sums.energy.baked += row_baked;
        sums.energy.noise += row_noise;
        sums.energy.error_to_bake += row_error;
        vertex_error_to_bake_[static_cast<size_t>(first + row)] += weight * row_error;
        const Index c =
            passing_class(x_hat_along.col(row).tail(size - 1), x_along.col(row).tail(size - 1));
        const auto add = [&](const MatrixXd& a, const MatrixXd& a_along, const MatrixXd& b,
                             const MatrixXd& b_along, MatrixXd& sums_of_class) {
            const VectorXd products = a_along.col(row).cwiseProduct(b_along.col(row));
            sums_of_class.col(c).head(size) += products;
            sums_of_class(size, c) += a.col(row).dot(b.col(row)) - products.sum();
        };
        add(x_hat, x_hat_along, x, x_along, sums.directions.decoded_baked);
        add(x, x_along, x, x_along, sums.directions.baked);
        add(d, d_along, d, d_along, sums.directions.noise);
    }
    return sums;
}

void TransferErrorMeter::add(uint32_t plane, const Plane& baked, const Plane& noise,
                             const Plane& decoded) {
    PAIM_CHECK_LT(plane, layout_.num_planes());
    PAIM_CHECK(!added_[plane]);
    for (const Plane* const values : {&baked, &noise, &decoded}) {
        PAIM_CHECK_EQ(values->rows(), num_vertices_);
        PAIM_CHECK_EQ(values->cols(), num_poses_);
    }
    added_[plane] = true;
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
            directions_[band].add(block.directions);
            pose_error_to_bake_ += weight * block.pose_error_to_bake;
        }
    }
}

uint64_t TransferErrorMeter::scratch_bytes(uint64_t num_poses, uint64_t span_size,
                                           uint64_t num_threads) {
    // Three sums for each block; for each thread the rows and their coordinates along the span.
    return (uint64_t{kBlocksAtOnce} * 3 * (span_size + 1) * uint64_t{kNumClasses} +
            num_threads * uint64_t{kRowsAtOnce} * 6 * num_poses) *
           sizeof(double);
}

TransferError TransferErrorMeter::result() const {
    PAIM_CHECK(std::find(added_.begin(), added_.end(), false) == added_.end());
    TransferError result;
    result.bands = energy_;
    double baked = 0.0, noise = 0.0, error_to_bake = 0.0, expected = 0.0;
    std::vector<double> true_energy;
    for (uint32_t l = 0; l < layout_.in_bands; ++l) {
        TransferBandEnergy& band = result.bands[l];
        const DirectionSums& sums = directions_[l];
        for (Index j = 0; j < sums.baked.size(); ++j) {
            const double all = sums.baked(j);
            const double share = all > 0.0 ? sums.decoded_baked(j) / all : 0.0;
            // Sums along the complement of the span are differences; rounding can make them
            // negative.
            band.noise_covariance += std::clamp(share, 0.0, 1.0) * std::max(0.0, sums.noise(j));
        }
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
