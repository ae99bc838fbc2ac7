// Pieces that are judged by themselves: connected ones, small ones together, and ranges of edges.
#include "paim/metrics/judged_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "paim/mesh/face_vertices.h"

namespace paim {
namespace {

Topology strip(uint32_t num_vertices) {
    Topology topology{num_vertices, {}};
    for (uint32_t v = 0; v + 2 < num_vertices; ++v) topology.triangles.push_back({v, v + 1, v + 2});
    return topology;
}

JudgedPieces judged(const Topology& topology, const std::vector<double>& edge_lengths = {}) {
    return judged_pieces(topology, face_vertices(topology), edge_lengths);
}

TEST(JudgedPieces, AreLargeConnectedPiecesAndTheSmallOnesTogether) {
    Topology topology = strip(2000);
    topology.append(strip(100));
    for (int j = 0; j < 4; ++j) topology.append(strip(20));
    const JudgedPieces pieces = judged(topology);
    EXPECT_EQ(pieces.count, 3u);
    EXPECT_EQ(pieces.of_vertex[0], 0u);
    EXPECT_EQ(pieces.of_vertex[2000], 1u);
    for (size_t v = 2100; v < 2180; ++v) EXPECT_EQ(pieces.of_vertex[v], 2u) << v;
}

TEST(JudgedPieces, OfAFewVerticesAreATwentieth) {
    Topology topology = strip(190);
    topology.append(strip(10));
    EXPECT_EQ(judged(topology).count, 2u);
    // What has no face does not count.
    topology.num_vertices += 5000;
    EXPECT_EQ(judged(topology).count, 2u);
}

// A fine figure on a coarse ground that it is connected to.
TEST(JudgedPieces, AreToldApartByTheLengthsOfTheirEdges) {
    const Topology topology = strip(1000);
    std::vector<double> lengths(1000, 8.0);
    const auto count = [&](uint32_t num_fine, double length) {
        std::fill(lengths.begin(), lengths.end(), 8.0);
        std::fill_n(lengths.begin() + 500, num_fine, length);
        return judged(topology, lengths).count;
    };
    EXPECT_EQ(count(200, 8.0), 1u);
    EXPECT_EQ(count(200, 2.1), 1u);  // within a factor of four
    EXPECT_EQ(count(200, 1.9), 2u);
    EXPECT_EQ(count(200, 33.0), 2u);
    EXPECT_EQ(count(49, 1.0), 1u);   // too few
    EXPECT_EQ(count(50, 1.0), 2u);   // a twentieth
    EXPECT_EQ(count(200, 0.0), 1u);  // unknown
    // A hundred vertices are enough for a connected piece, not for a range.
    EXPECT_EQ(judged(strip(4000),
                     [] {
                         std::vector<double> many(4000, 8.0);
                         std::fill_n(many.begin(), 150, 1.0);
                         return many;
                     }())
                  .count,
              1u);
    EXPECT_EQ(judged(topology, lengths).of_vertex[0], judged(topology, lengths).of_vertex[999]);
}

TEST(JudgedPieces, OfVeryFewVerticesAreNone) {
    Topology topology = strip(2000);
    topology.append(strip(7));
    EXPECT_EQ(judged(topology).count, 1u);
    EXPECT_EQ(judged(topology).of_vertex[2000], JudgedPieces::kNone);
    topology.append(strip(3));
    EXPECT_EQ(judged(topology).count, 2u);
    EXPECT_EQ(judged(Topology{7, {}}).count, 0u);
}

TEST(MeanEdgeLengths, AreOfAllEdgesInAllPoses) {
    const std::array<uint32_t, 2> edges[] = {{0, 1}, {0, 2}};
    // Vertices (0, 0, 0), (3, 0, 0), (0, 4, 0) and one without edges; then twice as large.
    const std::vector<float> small{0, 3, 0, 9, 0, 0, 4, 9, 0, 0, 0, 9};
    std::vector<float> large = small;
    for (float& x : large) x *= 2.0f;
    const std::vector<float> poses[] = {small, large};
    EXPECT_EQ(mean_edge_lengths(4, edges, poses), (std::vector<double>{5.25, 4.5, 6.0, 0.0}));
    EXPECT_EQ(mean_edge_lengths(4, edges, {}), std::vector<double>(4, 0.0));
}

}  // namespace
}  // namespace paim
