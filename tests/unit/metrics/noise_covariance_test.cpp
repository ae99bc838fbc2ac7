// The noise of a bake that a decoder lets through, where the truth is known.
#include "paim/metrics/noise_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include <cmath>
#include <numeric>

#include "paim/base/tbb_parallel.h"
#include "tests/unit/metrics/random_planes.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::VectorXd;

constexpr Index kVertices = 2400, kPoses = 8, kPlanes = 4;  // of two bands
constexpr Index kColumns = kPlanes * kPoses;
constexpr uint32_t kGroups = 6, kComponents = 3;
constexpr Index kMembers = kVertices / kGroups;
const TransferLayout kLayout{TransferKind::diffuse, 2, 1};

MatrixXd every_direction() {
    MatrixXd span = MatrixXd::Identity(kPoses, kPoses);
    span.col(0).setConstant(1.0 / std::sqrt(double{kPoses}));
    return span.householderQr().householderQ() * MatrixXd::Identity(kPoses, kPoses);
}

Index column_of(Index plane, Index pose) {
    return plane * kPoses + pose;
}

// All planes and poses of a vertex are a row of these; vertices of a group follow one another.
struct Bake {
    MatrixXd truth, baked, noise;  // [V][planes P]
};

// Each group is a mean and three components of singular values 24, 12 and 6 times √V_g; the noise is
// 0.3 in band 0 and 0.9 in band 1, so that its singular values are at most 0.9 (1 + √(32 / V_g)) √V_g.
Bake make_bake() {
    Bake bake{MatrixXd(kVertices, kColumns), {}, {}};
    for (uint32_t g = 0; g < kGroups; ++g) {
        const MatrixXd basis =
            gaussian(kColumns, kComponents, 100 + g).householderQr().householderQ() *
            MatrixXd::Identity(kColumns, kComponents);
        MatrixXd coefficients = gaussian(kMembers, kComponents, 200 + g);
        coefficients *= Eigen::Vector3d(24.0, 12.0, 6.0).asDiagonal();
        const Eigen::RowVectorXd mean = 5.0 * gaussian(1, kColumns, 300 + g);
        bake.truth.middleRows(Index{g} * kMembers, kMembers) =
            (coefficients * basis.transpose()).rowwise() + mean;
    }
    Eigen::RowVectorXd sigma(kColumns);
    for (Index j = 0; j < kColumns; ++j) sigma(j) = j < kPoses ? 0.3 : 0.9;
    bake.baked = bake.truth + gaussian(kVertices, kColumns, 1) * sigma.asDiagonal();
    bake.noise = gaussian(kVertices, kColumns, 2) * sigma.asDiagonal();
    return bake;
}

// Mean and components of each group, fitted to the bake; coefficients are rounded to multiples of a
// step, if it is not 0.
struct Clusters {
    PointGroups groups;
    MatrixXd points;   // [N][planes P]
    MatrixXd decoded;  // [V][planes P]
};

Clusters fit_clusters(const Bake& bake, double step) {
    constexpr Index kEach = kComponents + 1;
    Clusters clusters{{kGroups, std::vector<uint32_t>(kVertices), MatrixXf(kVertices, kEach), true},
                      MatrixXd(kGroups * kEach, kColumns),
                      MatrixXd(kVertices, kColumns)};
    for (uint32_t g = 0; g < kGroups; ++g) {
        const Index first = Index{g} * kMembers;
        const MatrixXd values = bake.baked.middleRows(first, kMembers);
        const Eigen::RowVectorXd mean = values.colwise().mean();
        const Eigen::BDCSVD<MatrixXd> svd(values.rowwise() - mean,
                                          Eigen::ComputeThinU | Eigen::ComputeThinV);
        MatrixXd factors(kMembers, kEach);
        factors.col(0).setOnes();
        factors.rightCols(kComponents) = svd.matrixU().leftCols(kComponents) *
                                         svd.singularValues().head(kComponents).asDiagonal();
        if (step > 0.0) {
            factors.rightCols(kComponents) =
                (factors.rightCols(kComponents) / step).array().rint() * step;
        }
        MatrixXd points(kEach, kColumns);
        points << mean, svd.matrixV().leftCols(kComponents).transpose();
        std::fill_n(clusters.groups.group.begin() + first, kMembers, g);
        clusters.groups.factors.middleRows(first, kMembers) = factors.cast<float>();
        clusters.points.middleRows(Index{g} * kEach, kEach) = points;
        clusters.decoded.middleRows(first, kMembers) = factors * points;
    }
    return clusters;
}

MatrixXf plane_of(const MatrixXd& values, uint32_t plane) {
    return values.middleCols(column_of(plane, 0), kPoses).cast<float>();
}

DecodedPoints decoded_points(const Clusters& clusters) {
    return {clusters.groups, [&clusters](uint32_t plane) -> std::optional<MatrixXf> {
                return plane_of(clusters.points, plane);
            }};
}

std::vector<double> measure(const Bake& bake, const MatrixXd& decoded,
                            std::optional<DecodedPoints> points,
                            const BandPower& spectrum = BandPower::flat(2)) {
    NoiseCovariance covariance(kLayout, kVertices, spectrum, every_direction(), std::move(points));
    for (uint32_t plane = 0; plane < kPlanes; ++plane) {
        covariance.survey(plane, plane_of(bake.baked, plane), plane_of(bake.noise, plane));
    }
    for (uint32_t plane = 0; plane < kPlanes; ++plane) {
        covariance.add(plane, plane_of(bake.baked, plane), plane_of(bake.noise, plane),
                       plane_of(decoded, plane));
    }
    return covariance.result();
}

// ⟨x̂ − t, x − t⟩ of a band: its expectation is tr cov(x̂, x − t).
double true_covariance(const Bake& bake, const MatrixXd& decoded, uint32_t band) {
    const Index first = band == 0 ? 0 : kPoses;
    const Index count = band == 0 ? kPoses : kColumns - kPoses;
    return ((decoded - bake.truth).cwiseProduct(bake.baked - bake.truth))
        .middleCols(first, count)
        .sum();
}

// A fit of C values by J components and a mean has (J + 1) C + J (V_g − J − 1) numbers a group; so much
// of the noise does it follow. Sums of as many squares, here 1,250 to 7,500 a band and more, scatter by
// 2 to 4 %; both sides do.
TEST(NoiseCovariance, OfClustersIsThatOfTheirFit) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake, 0.0);
    const std::vector<double> measured = measure(bake, clusters.decoded, decoded_points(clusters));
    for (uint32_t band = 0; band < 2; ++band) {
        const double expected = true_covariance(bake, clusters.decoded, band);
        EXPECT_NEAR(measured[band] / expected, 1.0, 0.15) << band;
    }
    const double degrees =
        kGroups * ((kComponents + 1.0) * kColumns + kComponents * (kMembers - kComponents - 1.0));
    const double noise = bake.noise.squaredNorm() / (kVertices * kColumns);
    EXPECT_NEAR((measured[0] + measured[1]) / (degrees * noise), 1.0, 0.05);
    // As if each vertex were decoded by itself, nearly all of the noise would be let through.
    const std::vector<double> alone = measure(bake, clusters.decoded, {});
    EXPECT_GT(alone[0] + alone[1], 3.0 * (measured[0] + measured[1]));
}

// Coefficients that are rounded to zero let no noise through.
TEST(NoiseCovariance, OfClustersCountsWhatRoundingTakesAway) {
    const Bake bake = make_bake();
    const Clusters exact = fit_clusters(bake, 0.0);
    const Clusters rounded = fit_clusters(bake, 26.0);
    const std::vector<double> all = measure(bake, exact.decoded, decoded_points(exact));
    const std::vector<double> fewer = measure(bake, rounded.decoded, decoded_points(rounded));
    // Rounding x of deviation s to multiples of Δ lets Σ Δ p(edges) of small noise through: 2 Δ p(Δ/2),
    // which is a third for the last component, and all for the first.
    EXPECT_LT(fewer[1], 0.88 * all[1]);
    EXPECT_NEAR(fewer[1] / true_covariance(bake, rounded.decoded, 1), 1.0, 0.1);
}

// Vertices that share one point, each times a number of its own: a fit has V + G C − G numbers.
TEST(NoiseCovariance, OfSharedPointsCountsNumbersOfVerticesAndPoints) {
    Bake bake = make_bake();
    Clusters clusters{{kGroups, std::vector<uint32_t>(kVertices), MatrixXf(kVertices, 1), false},
                      MatrixXd(kGroups, kColumns),
                      MatrixXd(kVertices, kColumns)};
    for (uint32_t g = 0; g < kGroups; ++g) {
        const Index first = Index{g} * kMembers;
        const VectorXd gains = (10.0 * gaussian(kMembers, 1, 400 + g)).eval();
        const VectorXd noise_free = gaussian(kColumns, 1, 500 + g).normalized() * 5.0;
        const MatrixXd noise =
            bake.baked.middleRows(first, kMembers) - bake.truth.middleRows(first, kMembers);
        bake.truth.middleRows(first, kMembers) = gains * noise_free.transpose();
        bake.baked.middleRows(first, kMembers) = bake.truth.middleRows(first, kMembers) + noise;
        const Eigen::BDCSVD<MatrixXd> svd(bake.baked.middleRows(first, kMembers),
                                          Eigen::ComputeThinU | Eigen::ComputeThinV);
        const VectorXd factors = svd.matrixU().col(0) * svd.singularValues()(0);
        std::fill_n(clusters.groups.group.begin() + first, kMembers, g);
        clusters.groups.factors.middleRows(first, kMembers) = factors.cast<float>();
        clusters.points.row(g) = svd.matrixV().col(0).transpose();
        clusters.decoded.middleRows(first, kMembers) = factors * svd.matrixV().col(0).transpose();
    }
    const std::vector<double> measured = measure(bake, clusters.decoded, decoded_points(clusters));
    const double sum = measured[0] + measured[1];
    const double noise = bake.noise.squaredNorm() / (kVertices * kColumns);
    // As above; noise differs between columns, and so do the points.
    EXPECT_NEAR(sum / (noise * (kVertices + kGroups * (kColumns - 1.0))), 1.0, 0.1);
    EXPECT_NEAR(sum / (true_covariance(bake, clusters.decoded, 0) +
                       true_covariance(bake, clusters.decoded, 1)),
                1.0, 0.1);
}

// Fitted where band 1 counts a hundredth, factors follow band 0 alone: they copy no noise of band 1
// but for what follows the points.
TEST(NoiseCovariance, OfClustersGoesByTheLight) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake, 0.0);
    const BandPower dark{"dark", {1.0, 1e-6}, 0.0};
    const std::vector<double> flat = measure(bake, clusters.decoded, decoded_points(clusters));
    const std::vector<double> weighted =
        measure(bake, clusters.decoded, decoded_points(clusters), dark);
    // Of band 0, J axes of all 8 directions instead of some part of those of 32.
    EXPECT_GT(weighted[0], 1.5 * flat[0]);
    EXPECT_LT(weighted[1], 0.7 * flat[1]);
}

TEST(NoiseCovariance, DoesNotDependOnThreads) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake, 1.0);
    const auto run = [&](int num_threads, bool grouped) {
        const ThreadLimit limit(num_threads);
        return measure(bake, clusters.decoded,
                       grouped ? std::optional(decoded_points(clusters)) : std::nullopt);
    };
    for (const bool grouped : {false, true}) EXPECT_EQ(run(1, grouped), run(4, grouped));
}

TEST(NoiseCovarianceDeathTest, NeedsASurvey) {
    const Bake bake = make_bake();
    NoiseCovariance covariance(kLayout, kVertices, BandPower::flat(2), every_direction(), {});
    EXPECT_DEATH(covariance.add(0, plane_of(bake.baked, 0), plane_of(bake.noise, 0),
                                plane_of(bake.baked, 0)),
                 "is_surveyed_");
}

}  // namespace
}  // namespace paim
