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

struct Clusters {
    PointGroups groups;
    MatrixXd points;   // [N][planes P]
    MatrixXd decoded;  // [V][planes P]
};

// Mean and components of each group, fitted to the bake.
// weights  [planes] of squared errors
// step     coefficients are rounded to its multiples, unless it is 0
Clusters fit_clusters(const Bake& bake, const Eigen::Vector4d& weights = Eigen::Vector4d::Ones(),
                      double step = 0.0) {
    constexpr Index kEach = kComponents + 1;
    Clusters clusters{{kGroups, std::vector<uint32_t>(kVertices), MatrixXf(kVertices, kEach), true},
                      MatrixXd(kGroups * kEach, kColumns),
                      MatrixXd(kVertices, kColumns)};
    Eigen::RowVectorXd root(kColumns);
    for (Index j = 0; j < kColumns; ++j) root(j) = std::sqrt(weights(j / kPoses));
    for (uint32_t g = 0; g < kGroups; ++g) {
        const Index first = Index{g} * kMembers;
        const MatrixXd values = bake.baked.middleRows(first, kMembers);
        const Eigen::RowVectorXd mean = values.colwise().mean();
        const Eigen::BDCSVD<MatrixXd> svd((values.rowwise() - mean) * root.asDiagonal(),
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
        points << mean,
            svd.matrixV().leftCols(kComponents).transpose() * root.cwiseInverse().asDiagonal();
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

// num_planes  that the file has, from the first
DecodedPoints decoded_points(const Clusters& clusters, uint32_t num_planes = kPlanes) {
    return {clusters.groups, [&clusters, num_planes](uint32_t plane) -> std::optional<MatrixXf> {
                if (plane >= num_planes) return {};
                return plane_of(clusters.points, plane);
            }};
}

std::vector<double> measure(const Bake& bake, const MatrixXd& decoded,
                            std::optional<DecodedPoints> points,
                            const BandPower& spectrum = BandPower::flat(2),
                            uint32_t num_planes = kPlanes) {
    NoiseCovariance covariance(kLayout, kVertices, spectrum, every_direction(), std::move(points));
    for (uint32_t plane = 0; plane < num_planes; ++plane) {
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

// A fit of C values by J components and a mean has (J + 1) C + J (V_g − J − 1) numbers a group. It
// follows that part of the noise. Sums of as many squares, here 1,250 to 7,500 a band, scatter by
// √(2 / 1,250) = 4 % and less. Both sides do, and the tolerance is near four of these deviations.
TEST(NoiseCovariance, OfClustersIsThatOfTheirFit) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake);
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
    const Clusters exact = fit_clusters(bake);
    const Clusters rounded = fit_clusters(bake, Eigen::Vector4d::Ones(), 26.0);
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
    // Of this fit, 2,400 + 186 numbers: √(2 / 2,586) = 3 %. The noise of a column is one of two sizes, and
    // a point may have more of one than of the other.
    EXPECT_NEAR(sum / (noise * (kVertices + kGroups * (kColumns - 1.0))), 1.0, 0.1);
    EXPECT_NEAR(sum / (true_covariance(bake, clusters.decoded, 0) +
                       true_covariance(bake, clusters.decoded, 1)),
                1.0, 0.1);
}

// Clusters that are fitted where band 1 counts little follow the noise of band 0 more, and that of band
// 1 less.
TEST(NoiseCovariance, OfClustersGoesByTheLight) {
    const Bake bake = make_bake();
    constexpr double kDark = 0.02;
    const Clusters clusters = fit_clusters(bake, {1.0, kDark, kDark, kDark});
    const std::vector<double> measured = measure(bake, clusters.decoded, decoded_points(clusters),
                                                 BandPower{"dark", {1.0, kDark}, 0.0});
    const std::vector<double> flat = measure(bake, clusters.decoded, decoded_points(clusters));
    for (uint32_t band = 0; band < 2; ++band) {
        const double expected = true_covariance(bake, clusters.decoded, band);
        // As in the first test. With axes of another light it would not be met, in one band at least.
        EXPECT_NEAR(measured[band] / expected, 1.0, 0.15) << band;
    }
    EXPECT_GT(std::abs(flat[0] / true_covariance(bake, clusters.decoded, 0) - 1.0), 0.2);
}

// A plane that the file does not have lets nothing through, and does not matter for the others.
TEST(NoiseCovariance, OfClustersCountsNoPlanesThatTheFileLacks) {
    const Bake bake = make_bake();
    constexpr uint32_t kStored = kPlanes - 1;
    Clusters clusters = fit_clusters(bake, {1.0, 1.0, 1.0, 1e-12});
    clusters.decoded.rightCols(kPoses).setZero();
    const std::vector<double> measured = measure(
        bake, clusters.decoded, decoded_points(clusters, kStored), BandPower::flat(2), kStored);
    MatrixXd stored_alone = clusters.decoded;
    stored_alone.rightCols(kPoses) = bake.truth.rightCols(kPoses);
    for (uint32_t band = 0; band < 2; ++band) {
        EXPECT_NEAR(measured[band] / true_covariance(bake, stored_alone, band), 1.0, 0.15) << band;
    }
}

// Squares of these numbers are beyond the range of floats.
TEST(NoiseCovariance, OfNumbersOfAnySizeIsInProportion) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake);
    for (const double scale : {1e25, 1e-25}) {
        const Bake scaled{scale * bake.truth, scale * bake.baked, scale * bake.noise};
        Clusters scaled_clusters = clusters;
        scaled_clusters.points *= scale;
        for (const bool grouped : {false, true}) {
            const auto points = [&](const Clusters& of) {
                return grouped ? std::optional(decoded_points(of)) : std::nullopt;
            };
            const std::vector<double> usual = measure(bake, clusters.decoded, points(clusters));
            const std::vector<double> result =
                measure(scaled, scale * clusters.decoded, points(scaled_clusters));
            for (uint32_t band = 0; band < 2; ++band) {
                // Roundings of floats, which put some values into another class.
                EXPECT_NEAR(result[band] / (scale * scale * usual[band]), 1.0, 1e-3)
                    << scale << " " << grouped;
            }
        }
    }
}

TEST(NoiseCovariance, DoesNotDependOnThreads) {
    const Bake bake = make_bake();
    const Clusters clusters = fit_clusters(bake, Eigen::Vector4d::Ones(), 1.0);
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
