// Noise along components, and shrinkage by it, on data whose signal and noise are known.
#include "compressor/encode/noise/component_noise.h"

#include <gtest/gtest.h>
#include <Eigen/QR>

#include <array>
#include <cmath>
#include <vector>

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
    // Energies fall by q = 0.75² from one to the next, so (q^k − q^6) / (1 − q^6) of them are left
    // after k: 0.15 after 3, 0.07 after 4. Asked for is 0.3² = 0.09.
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
        // Without shrinkage both sums are over thousands of squares, but components beyond the
        // signal are the directions in which this very noise is largest, by up to 1 + √(29 / 390)
        // there, and some percent over all: a tenth of the energy, a twentieth of the error. With
        // it, half of the vertices have no signal at all here, and what chance makes look like some
        // is counted: up to a fifth of the energy, a tenth of the error, on the cautious side.
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

// Vertices with noise n_v count as (Σ n_v)² / Σ n_v² of equal noise.
TEST(ComponentNoise, CountsIndependentVertices) {
    ComponentNoise noise;
    noise.layout = {TransferKind::diffuse, 2, 1};
    noise.num_vertices = 3;
    noise.vertex_noise = {1, 2, 0, 0, 1, 0};  // two bands: 1, 3 and 0 of both
    EXPECT_DOUBLE_EQ(noise.num_independent(), 16.0 / 10.0);
    noise.vertex_noise.assign(6, 0.0);
    EXPECT_EQ(noise.num_independent(), 0.0);
    EXPECT_EQ(ComponentNoise().num_independent(), 0.0);
}

// Four vertices, each with the same noise, and noise that is the same along all of four components:
// the edge is (1 + √((5 − 1) / 4))² = 4 times that. Energies are just above or just below it.
TEST(ComponentNoise, EndsAtTheEdgeOfPureNoise) {
    constexpr Index kColumns = 5, kComponents = kColumns - 1;
    MatrixXd hadamard(4, 4);  // rows and columns of length 2, orthogonal
    hadamard << 1, 1, 1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1, -1, -1, 1;
    // Orthonormal, without the constant.
    MatrixXd basis = gaussian(kColumns, kColumns, 1);
    basis.col(0).setOnes();
    PrincipalComponents components;
    components.v = (basis.householderQr().householderQ() * MatrixXd::Identity(kColumns, kColumns))
                       .rightCols(kComponents);
    components.singular_values = {4.0, 3.0, 2.0, 1.0};
    components.num_rows = 4;
    const MatrixXf noise = (hadamard * components.v.transpose()).cast<float>();
    // Far more than the floats' rounding, far less than the 12 % that one pose more would make.
    constexpr double kClose = 1e-4;
    const auto count = [&](const std::vector<int>& sides) {
        MatrixXd factors = hadamard;
        for (Index k = 0; k < kComponents; ++k) {
            factors.col(k) *= std::sqrt(4.0 * (1.0 + kClose * sides[static_cast<size_t>(k)]));
        }
        const MatrixXf transfer = (factors * components.v.transpose()).cast<float>();
        const ComponentNoise measured = measure_component_noise(
            MatrixRows(transfer), MatrixRows(noise), {TransferKind::diffuse, 1, 1}, components);
        EXPECT_NEAR(measured.num_independent(), 4.0, 1e-5);
        EXPECT_NEAR(measured.noise_of(0), 4.0, 1e-5);
        return measured.num_above_noise;
    };
    EXPECT_EQ(count({1, 1, 1, 1}), 4u);
    EXPECT_EQ(count({1, 1, -1, 1}), 2u);  // up to the first that is below
    EXPECT_EQ(count({-1, 1, 1, 1}), 0u);
}

// The risk is an unbiased estimate of the squared error that is left: with d values of which the
// noise n is known, 4 n²/d E is what Stein's term adds, and an n that is itself a sum of m draws
// adds
// 4 n²/m E. Equal components, so that one factor is that of all of them and nothing is modelled.
// One component of 33 values, then three of 11.
TEST(Shrinkage, ExpectsTheErrorThatManyDrawsHave) {
    constexpr uint32_t kBand = 5;  // 11 coefficients
    constexpr size_t kValues = 33;
    constexpr size_t kDraws = 66;  // of the noise: as many as twice the values
    constexpr int kTrials = 80'000;
    for (const uint32_t channels : {3u, 1u}) {
        const Index num_components = channels == 3 ? 1 : 3;
        ComponentNoise noise;
        noise.layout = {TransferKind::diffuse, kBand + 1, channels};
        noise.num_vertices = 1;
        noise.num_poses = static_cast<uint32_t>(kDraws / (11 * channels)) + 1;
        noise.num_above_noise = static_cast<uint32_t>(num_components);
        noise.mean_noise = 1000.0;  // so that estimates below zero are not taken for zero
        noise.energy = MatrixXd::Zero(kBand + 1, num_components);
        noise.noise = noise.energy;
        noise.vertex_energy.assign(kBand + 1, 0.0);
        noise.vertex_noise.assign(kBand + 1, 0.0);
        RandomStream random(17);
        const auto normal = [&] {
            const double radius = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
            return radius * std::cos(2.0 * kPi * random.uniform());
        };
        // Unit noise on values of 1: E is about twice n.
        double sum = 0.0, squares = 0.0, sum_of_ratio = 0.0;
        for (int trial = 0; trial < kTrials; ++trial) {
            std::array<double, kValues> values;
            double energy = 0.0;
            for (double& value : values) {
                value = 1.0 + normal();
                energy += value * value;
            }
            double estimate = 0.0;
            for (size_t j = 0; j < kDraws; ++j) {
                const double draw = normal();
                estimate += draw * draw * kValues / kDraws;
            }
            noise.vertex_energy.back() = energy;
            noise.vertex_noise.back() = estimate;
            for (Index k = 0; k < num_components; ++k) {
                const double share = 1.0 / static_cast<double>(num_components);
                noise.energy(kBand, k) = share * energy;
                noise.noise(kBand, k) = share * estimate;
            }
            const Shrinkage shrinkage(noise);
            const double factor = shrinkage.factor(kBand, 0, 0);
            double error = 0.0;
            for (const double value : values) error += std::pow(factor * value - 1.0, 2.0);
            const double expected =
                shrinkage.expected_error(static_cast<uint32_t>(num_components)).noise - 1000.0;
            const double difference = expected - error;
            sum += difference / kTrials;
            squares += difference * difference / kTrials;
            sum_of_ratio += kValues * kValues / energy / kTrials;
        }
        // Five standard errors, and what the estimated n² is too large by, 1 + 2/m, in both terms.
        const double standard_error = std::sqrt(squares / kTrials);
        const double bias = 8.0 / kDraws * (1.0 / kValues + 1.0 / kDraws) * sum_of_ratio;
        EXPECT_LT(std::abs(sum), bias + 5.0 * standard_error) << channels;
        // The smaller term is that of m draws: half of it would show, twice over.
        EXPECT_LT(bias + 5.0 * standard_error, 0.5 * 0.5 * 4.0 / kDraws * sum_of_ratio)
            << "else this would not say much";
    }
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
