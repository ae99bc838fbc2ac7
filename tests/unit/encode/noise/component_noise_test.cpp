// Noise along components, and shrinkage by it, on data whose signal and noise are known.
#include "compressor/encode/noise/component_noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/noise/shrinkage.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/base/vector.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

constexpr Index kVertices = 700;
constexpr Index kPoses = 30;
constexpr Index kRank = 6;
const TransferLayout kLayout{TransferKind::diffuse, 3, 1};
constexpr Index kRows = 9 * kVertices;

MatrixXd gaussian(Index rows, Index columns, uint64_t key) {
    RandomStream random(key);
    MatrixXd matrix(rows, columns);
    // Box and Muller.
    for (double& x : matrix.reshaped()) {
        const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
        x = radius * std::cos(2.0 * kPi * random.uniform());
    }
    return matrix;
}

// Low-rank movement of half of the vertices; noise that grows with the vertex and with the band.
class KnownNoise : public testing::Test {
  protected:
    KnownNoise() {
        const MatrixXd mean = gaussian(kRows, 1, 1);
        MatrixXd movement = gaussian(kRows, kRank, 2);
        for (Index k = 0; k < kRank; ++k) movement.col(k) *= std::pow(0.75, k);
        for (Index row = 0; row < kRows; ++row) {
            const Index v = row % kVertices;
            if (v >= kVertices / 2) movement.row(row).setZero();
            const auto band = sh::band_of(static_cast<int>(row / kVertices));
            const double vertex = static_cast<double>(v) / kVertices;
            sigma_(row) = noise_level_ * vertex * (1.0 + band);
        }
        signal_ = movement * gaussian(kRank, kPoses, 3);
        signal_.colwise() += mean.col(0);
        transfer_ = (signal_ + sigma_.asDiagonal() * gaussian(kRows, kPoses, 4)).cast<float>();
        noise_ = (sigma_.asDiagonal() * gaussian(kRows, kPoses, 5)).cast<float>();
    }

    PrincipalComponents components() const { return principal_components(MatrixRows(transfer_)); }
    ComponentNoise measure(const MatrixXf& noise) const {
        return measure_component_noise(MatrixRows(transfer_), MatrixRows(noise), kLayout,
                                       components());
    }

    // Mean and the first K components, with or without shrinkage.
    MatrixXd decoded(uint32_t num_components, const Shrinkage* shrinkage) const {
        const PrincipalComponents all = components();
        const MatrixXd v = all.v.leftCols(num_components);
        const Eigen::VectorXd mean = transfer_.cast<double>().rowwise().mean();
        MatrixXd factors = (transfer_.cast<double>().colwise() - mean) * v;
        if (shrinkage != nullptr) {
            std::vector<std::vector<float>> columns(num_components);
            for (uint32_t k = 0; k < num_components; ++k) {
                const Eigen::VectorXf column = factors.col(k).cast<float>();
                columns[k].assign(column.begin(), column.end());
            }
            // In two blocks that part within a plane.
            auto tail = columns;
            for (auto& column : tail) column.erase(column.begin(), column.begin() + 1000);
            for (auto& column : columns) column.resize(1000);
            shrinkage->apply(0, columns);
            shrinkage->apply(1000, tail);
            for (uint32_t k = 0; k < num_components; ++k) {
                columns[k].insert(columns[k].end(), tail[k].begin(), tail[k].end());
                factors.col(k) =
                    Eigen::Map<const Eigen::VectorXf>(columns[k].data(), kRows).cast<double>();
            }
        }
        return (factors * v.transpose()).colwise() + mean;
    }

    const double noise_level_ = 0.3;
    Eigen::VectorXd sigma_{kRows};
    MatrixXd signal_;
    MatrixXf transfer_, noise_;
};

TEST_F(KnownNoise, IsMeasuredAlongEveryComponent) {
    const ComponentNoise measured = measure(noise_);
    // A unit vector in the space of poses collects the variance of one column.
    const double expected = sigma_.squaredNorm();
    // Each is a sum of squares of kRows normal numbers of these variances.
    const double spread = std::sqrt(2.0 * sigma_.array().pow(4).sum());
    ASSERT_EQ(measured.noise.cols(), kPoses - 1);
    for (Index k = 0; k < kPoses - 1; ++k) {
        EXPECT_NEAR(measured.noise_of(k), expected, 5.0 * spread) << k;
    }
    // The mean over P poses has 1/P of a column's noise, and counts in each of P.
    EXPECT_NEAR(measured.mean_noise, expected, 5.0 * spread);
    EXPECT_NEAR(measured.energy.sum() /
                    (transfer_.cast<double>().colwise() - transfer_.cast<double>().rowwise().mean())
                        .squaredNorm(),
                1.0, 1e-12);
}

TEST_F(KnownNoise, ComponentsAboveItAreThoseOfTheSignal) {
    const ComponentNoise measured = measure(noise_);
    EXPECT_EQ(measured.num_above_noise, static_cast<uint32_t>(kRank));
    // However little error is asked for.
    EXPECT_EQ(choose_components({}, measured, 1e-9), static_cast<uint32_t>(kRank));
    EXPECT_EQ(choose_components({ComponentChoice::Kind::number, 9}, measured, 0.01), 9u);
    EXPECT_EQ(choose_components({ComponentChoice::Kind::all, 0}, measured, 0.01), 29u);
    // Energies fall by q = 0.75² from one to the next, so (q^k − q^6) / (1 − q^6) of them are left after
    // k: 0.15 after 3, 0.07 after 4. Asked for is 0.3² = 0.09.
    EXPECT_EQ(choose_components({}, measured, 0.3), 4u);
}

TEST_F(KnownNoise, ShrinkageLowersTheErrorToWhatItExpects) {
    const ComponentNoise measured = measure(noise_);
    const Shrinkage shrinkage(measured);
    const double raw = (transfer_.cast<double>() - signal_).squaredNorm();
    for (const uint32_t k : {2u, 6u, 15u, 29u}) {
        const double truncated = (decoded(k, nullptr) - signal_).squaredNorm();
        const double shrunk = (decoded(k, &shrinkage) - signal_).squaredNorm();
        EXPECT_LT(shrunk, truncated) << k;
        if (k >= kRank) {
            EXPECT_LT(shrunk, raw) << k;
        }
        // Without shrinkage both sums are over thousands of squares, but components beyond the signal are
        // the directions in which this very noise is largest, by up to 1 + √(29 / 390) there, and some
        // percent over all: a tenth of the energy, a twentieth of the error. With it, half of the vertices
        // have no signal at all here, and what chance makes look like some is counted: up to a fifth of
        // the energy, a tenth of the error, on the cautious side.
        EXPECT_NEAR(expected_error_unshrunk(measured, k).total() / truncated, 1.0, 0.1) << k;
        EXPECT_GT(shrinkage.expected_error(k).total() / shrunk, 0.95) << k;
        EXPECT_LT(shrinkage.expected_error(k).total() / shrunk, 1.25) << k;
    }
    // All components, shrunk, are far better than the bake itself.
    EXPECT_LT((decoded(29, &shrinkage) - signal_).squaredNorm(), 0.3 * raw);
}

TEST_F(KnownNoise, WithoutNoiseNothingChanges) {
    const ComponentNoise measured = measure(MatrixXf::Zero(kRows, kPoses));
    const Shrinkage shrinkage(measured);
    EXPECT_EQ(measured.num_above_noise, 29u);
    for (const uint32_t k : {0u, 7u, 28u}) {
        for (const size_t v : {size_t{0}, size_t{500}}) EXPECT_EQ(shrinkage.factor(1, v, k), 1.0);
    }
    EXPECT_EQ(shrinkage.expected_error(29).total(), 0.0);
    const double dropped = measured.energy.rightCols(26).sum();
    EXPECT_NEAR(shrinkage.expected_error(3).total() / dropped, 1.0, 1e-12);
}

TEST_F(KnownNoise, StillDataHasNoSignalToKeep) {
    transfer_.colwise() = signal_.col(0).cast<float>();
    transfer_ += 0.1f * noise_;
    const ComponentNoise measured =
        measure((0.1 * (sigma_.asDiagonal() * gaussian(kRows, kPoses, 6))).cast<float>());
    EXPECT_EQ(measured.num_above_noise, 0u);
    EXPECT_EQ(choose_components({}, measured, 0.01), 0u);
}

TEST_F(KnownNoise, DoesNotDependOnThreads) {
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        const ComponentNoise measured = measure(noise_);
        return std::make_pair(MatrixXd(measured.noise), measured.vertex_noise);
    };
    EXPECT_EQ(run(1), run(2));
}

}  // namespace
}  // namespace paim
