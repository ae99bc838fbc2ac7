// The parts of clustering: projection, seeds, subspaces, assignment, empty clusters, neighbours.
#include "compressor/encode/cluster/clustering.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <set>

#include "compressor/encode/cluster/cluster_assignment.h"
#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/cluster_seeding.h"
#include "compressor/encode/cluster/cluster_subspaces.h"
#include "compressor/encode/cluster/point_projection.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "tests/reference_svd.h"
#include "tests/unit/encode/cluster/random_matrix.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXf;

double distance(const MatrixXf& columns, Index a, Index b) {
    return (columns.col(a) - columns.col(b)).cast<double>().norm();
}

// --- projection

TEST(PointProjection, KeepsDistancesOfPointsThatHaveFewDimensions) {
    // 12 of 300 dimensions: the random projection finds them all, to the rounding of floats.
    const MatrixXf matrix = random_matrix(3000, 12, 1) * random_matrix(12, 300, 2);
    const MatrixXf projected = project_points(MatrixPoints(matrix, 10), 24, 1);
    EXPECT_LE(projected.rows(), 24);
    const MatrixXf columns = matrix.transpose();
    for (Index v = 1; v < 200; ++v) {
        // 300 products of floats, of unit order: 2^-24 √300 each way, with room for the largest.
        EXPECT_NEAR(distance(projected, 0, v) / distance(columns, 0, v), 1.0, 1e-5);
    }
}

TEST(PointProjection, FindsThePrincipalDirections) {
    MatrixXf matrix = random_matrix(2000, 120, 3);
    for (Index c = 0; c < 120; ++c) matrix.col(c) *= std::pow(0.9f, static_cast<float>(c));
    const MatrixXf projected = project_points(MatrixPoints(matrix, 6), 32, 1);
    ASSERT_EQ(projected.rows(), 32);
    Eigen::MatrixXd centred = matrix.cast<double>();
    centred.rowwise() -= centred.colwise().mean().eval();
    const ReferenceSvd svd = reference_svd(centred);
    const double left = svd.singular_values.tail(120 - 32).squaredNorm();
    const double left_here = centred.squaredNorm() - projected.cast<double>().squaredNorm();
    // Halko, Martinsson and Tropp, theorem 10.5: at most 1 + 32/15 in the mean, with 16 columns
    // beyond 32. Measured: 1.19.
    EXPECT_LT(left_here, 1.5 * left);
    EXPECT_GT(left_here, 0.99 * left);
}

// In more dimensions than the sketch has, and in fewer.
TEST(PointProjection, OfEqualPointsHasNoDirections) {
    for (const Index dimensions : {120, 20}) {
        const MatrixXf matrix = MatrixXf::Constant(50, dimensions, 0.3f);
        const MatrixXf projected = project_points(MatrixPoints(matrix, 10), 64, 1);
        EXPECT_EQ(projected.rows(), 0) << dimensions;
        EXPECT_EQ(projected.cols(), 50) << dimensions;
    }
}

TEST(PointProjection, OfFewDimensionsIsARotation) {
    const MatrixXf matrix = random_matrix(500, 30, 4);
    const MatrixXf projected = project_points(MatrixPoints(matrix, 3), 64, 1);
    ASSERT_EQ(projected.rows(), 30);
    const MatrixXf columns = matrix.transpose();
    for (Index v = 1; v < 100; ++v) {
        EXPECT_NEAR(distance(projected, 0, v), distance(columns, 0, v), 1e-5);
    }
}

// --- seeds

TEST(ClusterSeeding, SpreadsOverSeparateGroups) {
    // 20 groups, 1000 apart and 1 wide: by the second draw within a group a chance of 10^-6 is due.
    MatrixXf points = random_matrix(2, 2000, 5);
    for (Index v = 0; v < 2000; ++v) points(0, v) += 1000.0f * static_cast<float>(v % 20);
    const std::vector<uint32_t> seeds = seed_clusters(points, 20, 1);
    std::set<uint32_t> groups;
    for (const uint32_t v : seeds) groups.insert(v % 20);
    EXPECT_EQ(groups.size(), 20u);
}

TEST(ClusterSeeding, TakesNoPointTwice) {
    MatrixXf points = random_matrix(3, 7, 6).replicate(1, 50);
    EXPECT_EQ(seed_clusters(points, 100, 1).size(), 7u);
    EXPECT_EQ(seed_clusters(MatrixXf::Ones(3, 9), 4, 1).size(), 1u);
    EXPECT_TRUE(seed_clusters(MatrixXf(3, 0), 4, 1).empty());
}

// --- members

TEST(ClusterMembers, AreThePointsOfEachClusterInOrder) {
    const ClusterMembers members({2, 0, 2, 2, 0}, 4);
    EXPECT_EQ(members.size(1), 0u);
    EXPECT_EQ(std::vector<uint32_t>(members.of(0).begin(), members.of(0).end()),
              (std::vector<uint32_t>{1, 4}));
    EXPECT_EQ(std::vector<uint32_t>(members.of(2).begin(), members.of(2).end()),
              (std::vector<uint32_t>{0, 2, 3}));
}

TEST(ClusterMembers, EmptyClustersTakePartOfTheWorst) {
    // Cluster 0 is a point twice over; cluster 2 two groups of points far apart.
    MatrixXf points(1, 6);
    points << 5, 5, -10, -11, 10, 11;
    std::vector<uint32_t> cluster{0, 0, 2, 2, 2, 2};
    EXPECT_EQ(fill_empty_clusters(points, {0, 0, 100, 121, 100, 121}, 3, cluster), 0u);
    EXPECT_EQ(cluster[2], cluster[3]);
    EXPECT_EQ(cluster[4], cluster[5]);
    EXPECT_NE(cluster[2], cluster[4]);
    EXPECT_EQ(cluster[0], 0u);
}

TEST(ClusterMembers, EqualPointsCannotFillEmptyClusters) {
    std::vector<uint32_t> cluster{1, 1, 1};
    EXPECT_EQ(fill_empty_clusters(MatrixXf::Ones(2, 3), {1, 1, 1}, 3, cluster), 2u);
    EXPECT_EQ(drop_empty_clusters(3, cluster), 1u);
    EXPECT_EQ(cluster, (std::vector<uint32_t>{0, 0, 0}));
}

// --- subspaces and assignment

TEST(ClusterSubspaces, AreThePrincipalDirectionsOfTheMembers) {
    MatrixXf points = random_matrix(20, 3000, 7);
    for (Index j = 0; j < 20; ++j) points.row(j) *= std::pow(0.5f, static_cast<float>(j));
    const std::vector<uint32_t> cluster(3000, 0);
    const ClusterMembers members(cluster, 1);
    ClusterSubspaces subspaces(20, 1, 3);
    subspaces.fit(points, members, 1);
    Eigen::MatrixXd centred = points.cast<double>();
    const Eigen::VectorXd mean = centred.rowwise().mean();
    centred.colwise() -= mean;
    const ReferenceSvd svd = reference_svd(centred);
    EXPECT_LT((subspaces.columns().col(0).cast<double>() - mean).norm(), 1e-7);
    for (Index k = 0; k < 3; ++k) {
        // Four steps of 3 directions, spectrum falling by 4: the third is off by 4^-4 at most.
        const double cosine = svd.u.col(k).dot(subspaces.columns().col(1 + k).cast<double>());
        EXPECT_GT(std::abs(cosine), 1.0 - 1.0 / 256.0);
    }
    // The trace of the projection onto the fit is what it has of the points: 1 + K.
    double leverages = 0.0;
    for (Index v = 0; v < 3000; ++v) leverages += subspaces.leverage(0, points.col(v));
    EXPECT_NEAR(leverages, 4.0, 1e-3);
}

struct Assigned {
    MatrixXf points = random_matrix(10, 700, 8);
    std::vector<uint32_t> before;
    ClusterSubspaces subspaces{10, 7, 2};
    std::vector<uint32_t> after;
    std::vector<float> distance;

    // num_neighbours  of the clusters that points may go to
    explicit Assigned(uint32_t num_neighbours) {
        for (uint32_t v = 0; v < 700; ++v) before.push_back(v % 7);
        subspaces.fit(points, ClusterMembers(before, 7), 1);
        after = before;
        assign_points(points, subspaces, ClusterNeighbours(subspaces, num_neighbours), after,
                      distance);
    }

    // By definition, in double.
    double squared_distance(const Eigen::VectorXf& point, Index c) const {
        const Eigen::MatrixXd columns = subspaces.columns().middleCols(3 * c, 3).cast<double>();
        const Eigen::VectorXd x = point.cast<double>() - columns.col(0);
        return x.squaredNorm() - (columns.rightCols(2).transpose() * x).squaredNorm();
    }
    // What counts for point v.
    double cost(Index v, uint32_t c) const {
        const double own = 1.0 - subspaces.leverage(c, points.col(v));
        return squared_distance(points.col(v), c) /
               (c == before[static_cast<size_t>(v)] ? own : 1.0);
    }
};

TEST(ClusterAssignment, IsToTheNearestSubspaceAsTheDefinitionSays) {
    const Assigned assigned(7);
    uint32_t num_moved = 0;
    for (Index v = 0; v < 700; ++v) {
        const auto at = static_cast<size_t>(v);
        for (uint32_t c = 0; c < 7; ++c) {
            // Ten products of floats below 1.
            EXPECT_LE(assigned.cost(v, assigned.after[at]), assigned.cost(v, c) + 1e-5);
        }
        EXPECT_NEAR(assigned.distance[at],
                    assigned.squared_distance(assigned.points.col(v), assigned.after[at]), 1e-5);
        num_moved += assigned.after[at] != assigned.before[at];
    }
    EXPECT_GT(num_moved, 100u);
}

TEST(ClusterAssignment, IsToTheNearestOfTheNeighbours) {
    const Assigned assigned(3);
    const ClusterNeighbours neighbours(assigned.subspaces, 3);
    for (Index v = 0; v < 700; ++v) {
        const auto at = static_cast<size_t>(v);
        const auto near = neighbours.of(assigned.before[at]);
        EXPECT_TRUE(std::find(near.begin(), near.end(), assigned.after[at]) != near.end());
        for (const uint32_t c : near) {
            EXPECT_LE(assigned.cost(v, assigned.after[at]), assigned.cost(v, c) + 1e-5);
        }
    }
}

TEST(ClusterNeighbours, AreTheSubspacesNearestToTheMean) {
    const Assigned assigned(7);
    const ClusterNeighbours neighbours(assigned.subspaces, 3);
    for (Index c = 0; c < 7; ++c) {
        const auto near = neighbours.of(static_cast<size_t>(c));
        ASSERT_EQ(near.size(), 3u);
        EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
        EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<uint32_t>(c)));
        const Eigen::VectorXf mean = assigned.subspaces.columns().col(3 * c);
        double farthest = 0.0;
        for (const uint32_t n : near) {
            farthest = std::max(farthest, assigned.squared_distance(mean, n));
        }
        for (uint32_t n = 0; n < 7; ++n) {
            if (std::binary_search(near.begin(), near.end(), n)) continue;
            EXPECT_GT(assigned.squared_distance(mean, n), farthest - 1e-5);
        }
    }
}

// With a few clusters all are neighbours of all.
TEST(ClusterNeighbours, AreAllWhereThereAreFew) {
    const Assigned assigned(7);
    for (const ClusterNeighbours& all :
         {ClusterNeighbours(7), ClusterNeighbours(assigned.subspaces, 7),
          ClusterNeighbours(assigned.subspaces, 100)}) {
        for (size_t c = 0; c < 7; ++c) EXPECT_EQ(all.of(c).size(), 7u);
    }
}

// --- all together

// So many that a sample finds the clusters.
TEST(Clustering, ManyPointsJoinTheClustersOfSome) {
    constexpr Index kPoints = 60000, kGroups = 20;
    // Groups are 100 apart, and 1 wide along two directions of their own.
    MatrixXf points = 0.01f * random_matrix(8, kPoints, 12);
    const MatrixXf spread = random_matrix(2, kPoints, 13);
    for (Index v = 0; v < kPoints; ++v) {
        const Index group = v % kGroups;
        points(0, v) += 100.0f * static_cast<float>(group);
        points(1 + group % 7, v) += spread(0, v);
        points(1 + (group + 3) % 7, v) += spread(1, v);
    }
    ClusteringOptions options;
    options.num_clusters = kGroups;
    options.assumed_components = 2;
    const Clustering one = [&] {
        const ThreadLimit limit(1);
        return cluster_points(points, options);
    }();
    ASSERT_EQ(one.num_clusters, static_cast<uint32_t>(kGroups));
    for (size_t v = 0; v < static_cast<size_t>(kPoints); ++v) {
        ASSERT_EQ(one.cluster[v], one.cluster[v % kGroups]) << v;
    }
    const ThreadLimit limit(2);
    EXPECT_EQ(cluster_points(points, options).cluster, one.cluster);
}

TEST(Clustering, ManyEqualPointsAreOneCluster) {
    ClusteringOptions options;
    options.num_clusters = 4;
    const Clustering one = cluster_points(MatrixXf::Ones(3, 60000), options);
    EXPECT_EQ(one.num_clusters, 1u);
}

}  // namespace
}  // namespace paim
