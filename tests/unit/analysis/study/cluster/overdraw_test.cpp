#include "analysis/study/cluster/overdraw.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/seed.h"

namespace paim::study {
namespace {

// Columns of 2 vertices and 2 triangles between neighbouring columns.
Topology strip(uint32_t num_columns) {
    Topology topology{2 * num_columns, {}};
    for (uint32_t x = 0; x + 1 < num_columns; ++x) {
        const uint32_t a = 2 * x;
        topology.triangles.push_back({a, a + 1, a + 2});
        topology.triangles.push_back({a + 1, a + 3, a + 2});
    }
    return topology;
}

// A square of n x n vertices.
Topology square(uint32_t n) {
    Topology topology{n * n, {}};
    for (uint32_t y = 0; y + 1 < n; ++y) {
        for (uint32_t x = 0; x + 1 < n; ++x) {
            const uint32_t a = y * n + x;
            topology.triangles.push_back({a, a + 1, a + n});
            topology.triangles.push_back({a + 1, a + n + 1, a + n});
        }
    }
    return topology;
}

std::vector<uint32_t> groups_of(const std::vector<uint32_t>& cluster,
                                const std::vector<uint32_t>& group) {
    std::vector<uint32_t> of_vertices;
    for (const uint32_t c : cluster) of_vertices.push_back(group[c]);
    return of_vertices;
}

TEST(Overdraw, CountsGroupsOfEachTriangle) {
    const Topology topology{5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 3, 4}}};
    EXPECT_DOUBLE_EQ(overdraw(topology, std::vector<uint32_t>{0, 0, 0, 0, 0}), 1.0);
    // 1 + 2 + 3 + 3 groups.
    EXPECT_DOUBLE_EQ(overdraw(topology, std::vector<uint32_t>{5, 5, 5, 7, 6}), 9.0 / 4.0);
    EXPECT_TRUE(std::isnan(overdraw(Topology{3, {}}, std::vector<uint32_t>{0, 1, 2})));
}

// Six clusters of one column each in a ring would all have two triangles in common with the next. Of a
// strip in which clusters come back, the pairs differ: the best partition is known by trying all.
TEST(SuperClusters, AreTheBestOfAllPartitionsWhereGreedyIsBest) {
    const Topology topology = strip(11);
    // 0 and 2 touch four times, 1 and 3 three times, 2 and 1 twice, 3 and 0 once.
    const std::vector<uint32_t> columns{0, 2, 0, 2, 0, 3, 1, 3, 1, 2, 1};
    std::vector<uint32_t> cluster;
    for (const uint32_t c : columns) cluster.insert(cluster.end(), {c, c});
    double best = std::numeric_limits<double>::infinity();
    for (uint32_t code = 0; code < 256; ++code) {
        const std::vector<uint32_t> group{code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6 & 3};
        const auto is_large = [&](uint32_t g) {
            return std::count(group.begin(), group.end(), g) > 2;
        };
        if (std::any_of(group.begin(), group.end(), is_large)) continue;
        best = std::min(best, overdraw(topology, groups_of(cluster, group)));
    }
    const std::vector<uint32_t> group = super_clusters(topology, cluster, 4, 2);
    EXPECT_EQ(group, (std::vector<uint32_t>{0, 1, 0, 1}));
    EXPECT_DOUBLE_EQ(overdraw(topology, groups_of(cluster, group)), best);
    // 20 triangles, and 2 more for each of the 3 borders that are left.
    EXPECT_DOUBLE_EQ(best, 26.0 / 20.0);
}

// A triangle of three clusters counts for each pair, but only once for a pair that was merged with
// its third.
TEST(SuperClusters, CountATriangleOfThreeOnce) {
    // 0 1 2 meet in two triangles; 3 meets 2 in three.
    const Topology topology{12, {{0, 1, 2}, {0, 1, 2}, {2, 3, 3}, {2, 3, 3}, {2, 3, 3}, {0, 0, 1}}};
    std::vector<uint32_t> cluster(12, 0);
    for (uint32_t v = 0; v < 4; ++v) cluster[v] = v;
    // 0 and 1: 3, 2 and 3: 3. The first pair is merged, then the other; of {0, 1} and {2, 3} both
    // triangles of three are left.
    EXPECT_EQ(super_clusters(topology, cluster, 4, 2), (std::vector<uint32_t>{0, 0, 1, 1}));
    // With room for three, {0, 1} has two in common with 2, which has three with 3.
    EXPECT_EQ(super_clusters(topology, cluster, 4, 3), (std::vector<uint32_t>{0, 0, 1, 1}));
    EXPECT_EQ(super_clusters(topology, cluster, 4, 4), (std::vector<uint32_t>{0, 0, 0, 0}));
}

TEST(SuperClusters, OfOneClusterAreTheClusters) {
    const Topology topology = strip(3);
    EXPECT_EQ(super_clusters(topology, std::vector<uint32_t>{0, 0, 1, 1, 2, 2}, 3, 1),
              (std::vector<uint32_t>{0, 1, 2}));
}

TEST(GeometryCoherence, MovesAVertexToItsNeighbours) {
    const Topology topology = square(5);
    std::vector<uint32_t> cluster(25, 0);
    cluster[12] = cluster[24] = cluster[23] = cluster[19] = 1;
    // Its error in the other cluster is 4 % larger: within 5 %, not within 3 %.
    const VertexErrors error = [](uint32_t v, uint32_t c) {
        return v == 12 ? (c == 1 ? 1.0 : 1.04) : (c == (v >= 19 ? 1u : 0u) ? 0.5 : 9.0);
    };
    std::vector<uint32_t> strict = cluster;
    EXPECT_EQ(make_coherent(topology, error, 0.03, strict), 0u);
    EXPECT_EQ(strict, cluster);
    EXPECT_EQ(make_coherent(topology, error, 0.05, cluster), 1u);
    EXPECT_EQ(cluster[12], 0u);
    EXPECT_EQ(std::count(cluster.begin(), cluster.end(), 1u), 3);
}

TEST(GeometryCoherence, KeepsTheLastVertexOfACluster) {
    const Topology topology = square(3);
    std::vector<uint32_t> cluster(9, 0);
    cluster[4] = 1;
    EXPECT_EQ(make_coherent(
                  topology, [](uint32_t, uint32_t) { return 1.0; }, 0.5, cluster),
              0u);
    EXPECT_EQ(cluster[4], 1u);
}

// A vertex that moves twice is still judged by the cluster where it started: errors do not add up.
TEST(GeometryCoherence, NeverDrawsMoreAndKeepsErrorsWithinItsShare) {
    constexpr uint32_t kSide = 24, kClusters = 12;
    constexpr double kAlpha = 0.3;
    const Topology topology = square(kSide);
    RandomStream random(1);
    std::vector<std::vector<double>> errors(topology.num_vertices);
    std::vector<uint32_t> start;
    for (auto& of_vertex : errors) {
        for (uint32_t c = 0; c < kClusters; ++c) of_vertex.push_back(1.0 + random.uniform());
        const auto least = std::min_element(of_vertex.begin(), of_vertex.end());
        start.push_back(static_cast<uint32_t>(least - of_vertex.begin()));
    }
    std::vector<uint32_t> cluster = start;
    const uint32_t moves = make_coherent(
        topology, [&](uint32_t v, uint32_t c) { return errors[v][c]; }, kAlpha, cluster);
    EXPECT_GT(moves, topology.num_vertices / 4);
    EXPECT_LT(overdraw(topology, cluster), overdraw(topology, start));
    for (size_t v = 0; v < cluster.size(); ++v) {
        if (cluster[v] == start[v]) continue;
        EXPECT_LT(errors[v][cluster[v]], (1.0 + kAlpha) * errors[v][start[v]]);
    }
}

}  // namespace
}  // namespace paim::study
