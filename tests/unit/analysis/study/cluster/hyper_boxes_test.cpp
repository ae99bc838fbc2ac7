#include "analysis/study/cluster/hyper_boxes.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/clustering.h"
#include "paim/base/seed.h"

namespace paim::study {
namespace {

Eigen::MatrixXf random_points(Eigen::Index dimensions, Eigen::Index count) {
    RandomStream random(3);
    return Eigen::MatrixXf::NullaryExpr(dimensions, count,
                                        [&] { return static_cast<float>(random.uniform() - 0.5); });
}

TEST(HyperBoxes, AreCutAcrossTheirLongestSide) {
    Eigen::MatrixXf points(2, 5);
    points << 0, 1, 8, 8, 8,  //
        0, 0, 0, 1, 6;
    // x 0 … 8 is cut at 4; then y 0 … 6 of the right part at 3; then x 0 … 1 of the left part, which
    // is as long as y 0 … 1 of the right one.
    Eigen::MatrixXf two(2, 2), three(2, 3), four(2, 4);
    two << 0.5f, 8, 0, 7.0f / 3.0f;
    three << 0.5f, 8, 8, 0, 0.5f, 6;
    four << 0, 8, 8, 1, 0, 0.5f, 6, 0;
    EXPECT_EQ(hyper_box_means(points, 2), two);
    EXPECT_EQ(hyper_box_means(points, 3), three);
    EXPECT_EQ(hyper_box_means(points, 4), four);
    // As many as there are different points.
    points.col(1) = points.col(0);
    EXPECT_EQ(hyper_box_means(points, 9).cols(), 4);
}

// Ends of a side that are neighbours as floats: their middle must not be the upper one.
TEST(HyperBoxes, CutNeighbouringFloats) {
    Eigen::MatrixXf points(1, 2);
    points << std::nextafter(1.0f, 0.0f), 1.0f;
    EXPECT_EQ(hyper_box_means(points, 2), points);
}

// Every mean starts a cluster that has members in the end.
TEST(HyperBoxes, GiveNoEmptyCluster) {
    const Eigen::MatrixXf points = random_points(6, 500);
    const Eigen::MatrixXf means = hyper_box_means(points, 64);
    ASSERT_EQ(means.cols(), 64);
    ClusteringOptions options;
    options.assumed_components = 2;
    const Clustering clustering = cluster_points_from(points, means, options);
    EXPECT_EQ(clustering.num_clusters, 64u);
    const ClusterMembers members(clustering.cluster, clustering.num_clusters);
    for (size_t c = 0; c < 64; ++c) EXPECT_GT(members.size(c), 0u);
}

// Clusters of points that lie apart are found from one mean in each.
TEST(ClusterPointsFrom, StartsAtTheMeans) {
    Eigen::MatrixXf points = 0.1f * random_points(3, 90);
    for (Eigen::Index v = 0; v < 90; ++v) points(0, v) += static_cast<float>(v % 3);
    Eigen::MatrixXf means = Eigen::MatrixXf::Zero(3, 3);
    means.row(0) << 2.0f, 0.0f, 1.0f;
    const Clustering clustering = cluster_points_from(points, means, ClusteringOptions());
    const uint32_t expected[] = {1, 2, 0};
    for (size_t v = 0; v < 90; ++v) EXPECT_EQ(clustering.cluster[v], expected[v % 3]);
}

}  // namespace
}  // namespace paim::study
