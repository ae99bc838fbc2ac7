// How far a decoded transfer is from the bake, and how far it is expected to be from the truth.
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

double ratio(double part, double whole) {
    if (whole > 0.0) return std::sqrt(part / whole);
    return part > 0.0 ? std::numeric_limits<double>::infinity() : std::sqrt(part);
}

// The first of the largest; one that is not a number is larger than any.
template <typename Values>
size_t find_worst(const Values& values) {
    size_t worst = 0;
    for (size_t j = 1; j < static_cast<size_t>(values.size()); ++j) {
        if (!(values[j] <= values[worst])) worst = j;
        if (std::isnan(values[worst])) break;
    }
    return worst;
}

// Classes by the odds g / (1 − g) of what of a row's movement is let through, in steps of √2 from
// 2^-4 to 2^8: noise is let through by the same factors, which vary between vertices and components
// by their odds of signal to noise (Wiener).
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
                                       uint32_t num_poses, BandPower spectrum, MatrixXd kept)
    : layout_(layout),
      num_vertices_(static_cast<Index>(num_vertices)),
      num_poses_(static_cast<Index>(num_poses)),
      spectrum_(std::move(spectrum)),
      kept_(std::move(kept)),
      added_(layout.num_planes(), false),
      energy_(layout.in_bands),
      vertex_deviation_(num_vertices, 0.0),
      pose_deviation_(VectorXd::Zero(num_poses_)) {
    PAIM_CHECK_LE(1u, num_vertices);
    PAIM_CHECK_LE(1u, num_poses);
    PAIM_CHECK_LE(1u, layout.in_bands);
    PAIM_CHECK_EQ(kept_.rows(), num_poses_);
    PAIM_CHECK(kept_.cols() >= 1 && kept_.cols() <= num_poses_);
    // To far less than any error that is measured.
    constexpr double kRounding = 1e-9;
    const VectorXd constant = VectorXd::Constant(num_poses_, 1.0 / std::sqrt(num_poses));
    const MatrixXd identity = MatrixXd::Identity(kept_.cols(), kept_.cols());
    PAIM_CHECK_LT((kept_.col(0) - constant).cwiseAbs().maxCoeff(), kRounding);
    PAIM_CHECK_LT((kept_.transpose() * kept_ - identity).cwiseAbs().maxCoeff(), kRounding);
    factors_.assign(layout.in_bands, zero_factors());
}

TransferErrorMeter::ScaledFactors TransferErrorMeter::zero_factors() const {
    const MatrixXd zero = MatrixXd::Zero(kept_.cols() + 1, kNumClasses);
    return {zero, zero, zero};
}

void TransferErrorMeter::ScaledFactors::add(const ScaledFactors& other) {
    decoded_baked += other.decoded_baked;
    baked += other.baked;
    noise += other.noise;
}

TransferErrorMeter::RowSums TransferErrorMeter::measure_rows(Index first, Index count,
                                                             double weight, const Plane& baked,
                                                             const Plane& noise,
                                                             const Plane& decoded) {
    // A column a row of the data, so that both products read what is contiguous.
    const MatrixXd y = baked.middleRows(first, count).transpose().cast<double>();
    const MatrixXd d = noise.middleRows(first, count).transpose().cast<double>();
    const MatrixXd t = decoded.middleRows(first, count).transpose().cast<double>();
    const MatrixXd y_factors = kept_.transpose() * y;
    const MatrixXd d_factors = kept_.transpose() * d;
    const MatrixXd t_factors = kept_.transpose() * t;
    const Index kept = kept_.cols();
    RowSums sums{{}, zero_factors(), (t - y).rowwise().squaredNorm()};
    for (Index row = 0; row < count; ++row) {
        const double row_baked = y.col(row).squaredNorm();
        const double row_noise = d.col(row).squaredNorm();
        const double row_deviation = (t.col(row) - y.col(row)).squaredNorm();
        sums.energy.baked += row_baked;
        sums.energy.noise += row_noise;
        sums.energy.deviation += row_deviation;
        vertex_deviation_[static_cast<size_t>(first + row)] += weight * row_deviation;
        const Index c =
            passing_class(t_factors.col(row).tail(kept - 1), y_factors.col(row).tail(kept - 1));
        const auto add = [&](const MatrixXd& a, const MatrixXd& a_factors, const MatrixXd& b,
                             const MatrixXd& b_factors, MatrixXd& sums_of_class) {
            const VectorXd products = a_factors.col(row).cwiseProduct(b_factors.col(row));
            sums_of_class.col(c).head(kept) += products;
            sums_of_class(kept, c) += a.col(row).dot(b.col(row)) - products.sum();
        };
        add(t, t_factors, y, y_factors, sums.scores.decoded_baked);
        add(y, y_factors, y, y_factors, sums.scores.baked);
        add(d, d_factors, d, d_factors, sums.scores.noise);
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
            energy_[band].deviation += block.energy.deviation;
            factors_[band].add(block.scores);
            pose_deviation_ += weight * block.pose_deviation;
        }
    }
}

uint64_t TransferErrorMeter::scratch_bytes(uint64_t num_poses, uint64_t num_kept,
                                           uint64_t num_threads) {
    // Of each block its three sums; of each thread the rows and their factors.
    return (uint64_t{kBlocksAtOnce} * 3 * (num_kept + 1) * uint64_t{kNumClasses} +
            num_threads * uint64_t{kRowsAtOnce} * 6 * num_poses) *
           sizeof(double);
}

TransferError TransferErrorMeter::result() const {
    PAIM_CHECK(std::find(added_.begin(), added_.end(), false) == added_.end());
    TransferError result;
    result.bands = energy_;
    double baked = 0.0, noise = 0.0, deviation = 0.0, expected = 0.0;
    std::vector<double> true_energy;
    for (uint32_t l = 0; l < layout_.in_bands; ++l) {
        TransferBandEnergy& band = result.bands[l];
        const ScaledFactors& scores = factors_[l];
        for (Index j = 0; j < scores.baked.size(); ++j) {
            const double all = scores.baked(j);
            const double share = all > 0.0 ? scores.decoded_baked(j) / all : 0.0;
            // What is left beside the kept directions may be less than nothing by rounding.
            band.passed += std::clamp(share, 0.0, 1.0) * std::max(0.0, scores.noise(j));
        }
        const double weight = spectrum_.weight(l);
        baked += weight * band.baked;
        noise += weight * band.noise;
        deviation += weight * band.deviation;
        expected += weight * band.expected();
        true_energy.push_back(std::max(0.0, band.baked - band.noise));
    }
    result.deviation = ratio(deviation, baked);
    result.bake_noise = ratio(noise, baked);
    result.error = ratio(expected, baked);

    result.missing_bands = ratio(missing_band_energy(true_energy, spectrum_), baked);

    const size_t vertex = find_worst(vertex_deviation_);
    result.worst_vertex = static_cast<uint32_t>(vertex);
    result.worst_vertex_deviation =
        ratio(vertex_deviation_[vertex], baked / static_cast<double>(num_vertices_));
    const std::span<const double> poses(pose_deviation_.data(), static_cast<size_t>(num_poses_));
    const size_t pose = find_worst(poses);
    result.worst_pose = static_cast<uint32_t>(pose);
    result.worst_pose_deviation = ratio(poses[pose], baked / static_cast<double>(num_poses_));
    return result;
}

}  // namespace paim
