// Clustered principal components: what is known in closed form, what they say of themselves against
// what they give back, Eigen's SVD, odd inputs, threads and memory.
#include "compressor/encode/cluster/clustered_pca.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "compressor/encode/cluster/cluster_grams.h"
#include "paim/base/error.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "tests/reference_svd.h"
#include "tests/unit/encode/cluster/random_matrix.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

// Points of `num_groups` affine subspaces of so many dimensions, in turns, far from each other.
MatrixXf affine_groups(Index num_points, Index num_columns, Index num_groups, Index dimensions) {
    MatrixXf points(num_points, num_columns);
    const MatrixXf bases = random_matrix(num_groups * dimensions, num_columns, 21);
    const MatrixXf means = 20.0f * random_matrix(num_groups, num_columns, 22);
    const MatrixXf weights = random_matrix(num_points, dimensions, 23);
    for (Index v = 0; v < num_points; ++v) {
        const Index g = v % num_groups;
        points.row(v) =
            means.row(g) + weights.row(v) * bases.middleRows(g * dimensions, dimensions);
    }
    return points;
}

// Amplitudes that fall by a factor a column, turned so that every plane has some of each.
MatrixXf falling(Index num_points, Index num_columns, float factor, uint64_t seed) {
    MatrixXf points = random_matrix(num_points, num_columns, seed);
    for (Index c = 0; c < num_columns; ++c) {
        points.col(c) *= std::pow(factor, static_cast<float>(c));
    }
    return points * random_matrix(num_columns, num_columns, seed + 1);
}

// A curved surface: no number of flat clusters is exact.
MatrixXf curved(Index num_points, Index num_columns) {
    const MatrixXf places = 6.0f * random_matrix(num_points, 2, 31);
    const MatrixXf waves = random_matrix(2, num_columns, 32),
                   phases = random_matrix(1, num_columns, 33);
    MatrixXf points = places * waves;
    points.rowwise() += 6.0f * phases.row(0);
    return points.array().sin();
}

ClusteringOptions with(uint32_t num_clusters, uint32_t num_components) {
    ClusteringOptions options;
    options.num_clusters = num_clusters;
    options.assumed_components = options.max_components = num_components;
    return options;
}

MatrixXd reconstruct(const PointSource& points, const ClusteredPca& pca, uint32_t num_components) {
    MatrixXd result(points.num_points(), static_cast<Index>(points.num_dimensions()));
    const auto step = static_cast<Index>(num_components) + 1;
    for_each_basis_plane(points, pca, num_components, [&](uint32_t plane, const MatrixXf& rows) {
        for (Index v = 0; v < result.rows(); ++v) {
            const Index first = static_cast<Index>(pca.cluster[static_cast<size_t>(v)]) * step;
            result.row(v).segment(plane * points.num_columns(), points.num_columns()) =
                rows.row(first).cast<double>() +
                pca.coefficients.row(v).head(num_components).cast<double>() *
                    rows.middleRows(first + 1, num_components).cast<double>();
        }
    });
    return result;
}

// The error that the result says is what it gives back leaves, for every number of components.
void expect_identity(const MatrixXf& matrix, const PointSource& points, const ClusteredPca& pca) {
    const double total = matrix.cast<double>().squaredNorm();
    for (uint32_t k = 0; k <= pca.num_components; ++k) {
        const double left = (matrix.cast<double>() - reconstruct(points, pca, k)).squaredNorm();
        // Coefficients, means and bases are rounded to floats: each 2^-24 of its value at most, so
        // the values given back by √total (K + 2) 2^-24 together, and the error's square by that
        // times twice the error.
        const double rounding = std::sqrt(total) * (k + 2) * 0x1p-24;
        const double tolerance =
            2.0 * rounding * std::sqrt(pca.squared_error(k)) + rounding * rounding;
        EXPECT_NEAR(pca.squared_error(k), left, tolerance) << k << " components";
    }
}

// --- closed form

TEST(ClusteredPca, RecoversAffineSubspacesExactly) {
    constexpr uint32_t kGroups = 12, kDimensions = 3;
    const MatrixXf matrix = affine_groups(1200, 90, kGroups, kDimensions);
    const MatrixPoints points(matrix, 6);
    const ClusteredPca pca = clustered_pca(points, with(kGroups, kDimensions));
    ASSERT_EQ(pca.num_clusters, kGroups);
    for (size_t v = kGroups; v < 1200; ++v) {
        ASSERT_EQ(pca.cluster[v], pca.cluster[v % kGroups]);
    }
    EXPECT_EQ(std::set<uint32_t>(pca.cluster.begin(), pca.cluster.begin() + kGroups).size(),
              size_t{kGroups});
    // The points themselves are rounded to floats, and so far from their subspaces: by 2^-24 of
    // each value at most.
    const double total = matrix.cast<double>().squaredNorm();
    EXPECT_LT(std::sqrt(pca.squared_error(kDimensions) / total), 0x1p-24);
    EXPECT_GT(std::sqrt(pca.squared_error(kDimensions - 1) / total), 1e-3);
    expect_identity(matrix, points, pca);
}

TEST(ClusteredPca, CoefficientsHaveUnitRmsAndTheirLargestIsPositive) {
    const MatrixXf matrix = curved(900, 60);
    const ClusteredPca pca = clustered_pca(MatrixPoints(matrix, 5), with(10, 4));
    MatrixXd squares = MatrixXd::Zero(pca.num_clusters, 4);
    MatrixXf largest = MatrixXf::Zero(pca.num_clusters, 4);
    for (Index v = 0; v < 900; ++v) {
        const Index c = pca.cluster[static_cast<size_t>(v)];
        for (Index k = 0; k < 4; ++k) {
            const float x = pca.coefficients(v, k);
            squares(c, k) += static_cast<double>(x) * static_cast<double>(x);
            if (std::abs(x) > std::abs(largest(c, k))) largest(c, k) = x;
        }
    }
    for (Index c = 0; c < squares.rows(); ++c) {
        for (Index k = 0; k < 4; ++k) {
            EXPECT_NEAR(squares(c, k) / pca.size[static_cast<size_t>(c)], 1.0, 1e-6);
            EXPECT_GT(largest(c, k), 0.0f);
            if (k > 0) {
                EXPECT_LE(pca.singular_values(c, k), pca.singular_values(c, k - 1));
            }
        }
    }
}

// --- identity

TEST(ClusteredPca, SaysTheErrorThatIsLeft) {
    const MatrixXf matrix = curved(1500, 100);
    const MatrixPoints points(matrix, 4);
    expect_identity(matrix, points, clustered_pca(points, with(20, 6)));
}

TEST(ClusteredPca, SaysTheErrorThatIsLeftOfALargeCluster) {
    const MatrixXf matrix = falling(kMaxGramMembers + 500, 60, 0.9f, 41);
    const MatrixPoints points(matrix, 4);
    expect_identity(matrix, points, clustered_pca(points, with(1, 6)));
}

// --- slow reference

// tolerance of singular values, relative to the first
void expect_svd(Index num_points, Index num_columns, float factor, uint32_t num_components,
                double tolerance) {
    const MatrixXf matrix = falling(num_points, num_columns, factor, 51);
    const ClusteredPca pca = clustered_pca(MatrixPoints(matrix, 4), with(1, num_components));
    MatrixXd centred = matrix.cast<double>();
    centred.rowwise() -= centred.colwise().mean().eval();
    const ReferenceSvd svd = reference_svd(centred);
    for (Index k = 0; k < static_cast<Index>(num_components); ++k) {
        const double s = svd.singular_values[k];
        EXPECT_NEAR(pca.singular_values(0, k), s, tolerance * svd.singular_values[0]);
        const double cosine = pca.coefficients.col(k).cast<double>().dot(svd.u.col(k)) /
                              std::sqrt(static_cast<double>(num_points));
        // An angle squared costs as much of a value as values next to each other differ by: a
        // hundredth and more in all of these.
        EXPECT_NEAR(std::abs(cosine), 1.0, 100.0 * tolerance);
    }
    const double left =
        centred.squaredNorm() - svd.singular_values.head(num_components).squaredNorm();
    EXPECT_NEAR(pca.squared_error(num_components), left, 10.0 * tolerance * left);
}

TEST(ClusteredPca, OfOneClusterIsEigensSvd) {
    expect_svd(40, 100, 0.8f, 6, 1e-6);     // decomposed whole
    expect_svd(1000, 100, 0.95f, 6, 1e-6);  // passes
    expect_svd(1000, 20, 0.8f, 12, 1e-6);   // fewer dimensions than are iterated
}

TEST(ClusteredPca, OfOneClusterWhoseGramMatrixIsIteratedIsEigensSvd) {
    constexpr Index kPoints = 150, kColumns = 2000;
    ASSERT_TRUE(is_iterated(6, kPoints));
    ASSERT_LE(kPoints, static_cast<Index>(max_gram_members(kColumns, 6)));
    // The projection has almost all of it.
    expect_svd(kPoints, kColumns, 0.9f, 6, 1e-6);
    // More directions than the projection keeps, and falling slowly. Measured: 1e-5, and 7e-5 after
    // one step.
    expect_svd(kPoints, kColumns, 0.98f, 6, 2e-5);
}

TEST(ClusteredPca, OfOneLargeClusterIsEigensSvd) {
    expect_svd(kMaxGramMembers + 100, 100, 0.8f, 6, 1e-6);
    // More directions than the projection keeps, and falling slowly: three passes do not converge.
    // Measured: 4e-5, and more than 1e-3 after one pass.
    expect_svd(kMaxGramMembers + 100, 300, 0.98f, 6, 1e-4);
}

// --- more is never worse

TEST(ClusteredPca, MoreComponentsAndClustersAreNeverWorse) {
    const MatrixXf matrix = curved(2000, 80);
    const MatrixPoints points(matrix, 4);
    double before = matrix.cast<double>().squaredNorm();
    for (uint32_t num_clusters = 1; num_clusters <= 256; num_clusters *= 2) {
        const ClusteredPca pca = clustered_pca(points, with(num_clusters, 5));
        EXPECT_EQ(pca.num_clusters, num_clusters);
        for (uint32_t k = 1; k <= 5; ++k) {
            EXPECT_LE(pca.squared_error(k), pca.squared_error(k - 1));
        }
        // Each finds an optimum of its own, that need not be the best. Measured: 0.51 at most.
        EXPECT_LT(pca.squared_error(5), 0.6 * before);
        before = pca.squared_error(5);
    }
}

TEST(ClusteredPca, AffineRoundsGainOverMeans) {
    const MatrixXf matrix = curved(2000, 80);
    ClusteringOptions means = with(32, 4);
    means.affine_rounds = 0;
    const MatrixPoints points(matrix, 4);
    // Measured: a fifth of the squared error.
    EXPECT_LT(clustered_pca(points, with(32, 4)).squared_error(4),
              0.5 * clustered_pca(points, means).squared_error(4));
}

// --- odd inputs

TEST(ClusteredPca, OfNothingIsNothing) {
    const MatrixXf matrix(0, 12);
    const MatrixPoints points(matrix, 3);
    const ClusteredPca pca = clustered_pca(points, with(4, 2));
    EXPECT_EQ(pca.num_clusters, 0u);
    EXPECT_EQ(pca.squared_error(2), 0.0);
    uint32_t num_planes = 0;
    for_each_basis_plane(points, pca, 2, [&](uint32_t, const MatrixXf& rows) {
        EXPECT_EQ(rows.rows(), 0);
        ++num_planes;
    });
    EXPECT_EQ(num_planes, 3u);
}

TEST(ClusteredPca, OfEqualPointsIsTheirMean) {
    const MatrixXf matrix = random_matrix(1, 12, 61).replicate(50, 1);
    const MatrixPoints points(matrix, 3);
    const ClusteredPca pca = clustered_pca(points, with(4, 2));
    EXPECT_EQ(pca.num_clusters, 1u);
    EXPECT_EQ(pca.squared_error(0), 0.0);
    EXPECT_EQ(pca.coefficients, MatrixXf::Zero(50, 2));
    EXPECT_EQ(reconstruct(points, pca, 2), matrix.cast<double>());
}

// The transfer of a mesh that no light reaches; the larger cluster has no Gram matrix.
TEST(ClusteredPca, OfZerosIsNothing) {
    for (const Index num_points : {Index{50}, Index{kMaxGramMembers + 10}}) {
        const MatrixXf matrix = MatrixXf::Zero(num_points, 12);
        const ClusteredPca pca = clustered_pca(MatrixPoints(matrix, 3), with(4, 2));
        EXPECT_EQ(pca.num_clusters, 1u);
        EXPECT_EQ(pca.squared_error(0), 0.0);
        EXPECT_EQ(pca.coefficients, MatrixXf::Zero(num_points, 2));
    }
}

TEST(ClusteredPca, OfFewerPointsThanClustersOrComponents) {
    for (Index num_points = 1; num_points <= 6; ++num_points) {
        const MatrixXf matrix = random_matrix(num_points, 12, 62);
        const MatrixPoints points(matrix, 3);
        for (const auto& options : {with(4, 8), with(100, 2), with(1, 3)}) {
            const ClusteredPca pca = clustered_pca(points, options);
            EXPECT_LE(pca.num_clusters,
                      std::min<uint32_t>(options.num_clusters, static_cast<uint32_t>(num_points)));
            uint32_t sum = 0;
            for (const uint32_t size : pca.size) {
                EXPECT_GT(size, 0u);
                sum += size;
            }
            EXPECT_EQ(sum, static_cast<uint32_t>(num_points));
            EXPECT_TRUE(pca.coefficients.allFinite());
            expect_identity(matrix, points, pca);
        }
    }
}

TEST(ClusteredPca, ComponentsBeyondARankAreZero) {
    const MatrixXf matrix = affine_groups(300, 40, 1, 2);
    const ClusteredPca pca = clustered_pca(MatrixPoints(matrix, 4), with(1, 60));
    // Rank 2, and what rounding to floats adds, up to the 40 dimensions.
    EXPECT_GT(pca.singular_values(0, 1), 1e4 * pca.singular_values(0, 2));
    EXPECT_EQ(pca.singular_values.row(0).tail(20).norm(), 0.0);
    EXPECT_EQ(pca.coefficients.rightCols(20).norm(), 0.0f);
}

// --- bytes and memory

void expect_same(const ClusteredPca& a, const ClusteredPca& b) {
    EXPECT_EQ(a.cluster, b.cluster);
    EXPECT_EQ(a.coefficients, b.coefficients);
    EXPECT_EQ(a.singular_values, b.singular_values);
    EXPECT_EQ(a.energy, b.energy);
}

TEST(ClusteredPca, IsTheSameOnAnyNumberOfThreadsAndInAnyMemory) {
    // With a cluster that is too large for its Gram matrix, and many that are not.
    const MatrixXf matrix = falling(3000, 200, 0.95f, 71);
    MatrixXf all(3000 + kMaxGramMembers + 10, 200);
    all << matrix, 1e-3f * falling(kMaxGramMembers + 10, 200, 0.9f, 72);
    const MatrixPoints points(all, 8);
    ClusteringOptions options = with(40, 5);
    const auto run = [&](int num_threads) {
        const ThreadLimit limit(num_threads);
        return clustered_pca(points, options);
    };
    const ClusteredPca one = run(1);
    EXPECT_GT(*std::max_element(one.size.begin(), one.size.end()), kMaxGramMembers);
    EXPECT_LT(*std::min_element(one.size.begin(), one.size.end()), max_gram_members(200, 5));
    expect_same(one, run(2));
    options.memory_bytes = clustered_pca_memory_bytes(points, options);
    expect_same(one, run(1));
    options.seed = 2;
    EXPECT_NE(one.cluster, run(1).cluster);
}

TEST(ClusteredPca, RefusesLessMemoryThanItNeedsAndSaysHowMuch) {
    // Never read: 42,000 points of 1,200 values.
    class Unread : public PointSource {
      public:
        uint32_t num_points() const override { return 42000; }
        uint32_t num_planes() const override { return 25; }
        uint32_t num_columns() const override { return 48; }
        void read(uint32_t, Eigen::Ref<MatrixXf>) const override { FAIL(); }
    };
    const ThreadLimit limit(2);
    ClusteringOptions options = with(256, 8);
    const uint64_t needed = clustered_pca_memory_bytes(Unread(), options);
    // Less than the points themselves take.
    EXPECT_LT(needed, uint64_t{42000} * 1200 * sizeof(float));
    options.memory_bytes = 50'000'000;
    try {
        clustered_pca(Unread(), options, "x.bake");
        FAIL() << "not refused";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unsupported);
        EXPECT_EQ(std::string(error.what()),
                  "x.bake: 42000 points of 1200 values in 256 clusters of 8 components need " +
                      std::to_string(needed / 1'000'000 + 1) +
                      " MB of memory, but 50 MB are allowed");
    }
}

}  // namespace
}  // namespace paim
