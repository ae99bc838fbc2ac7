// Connected pieces: numbers, sizes, and vertices of no face.
#include "paim/mesh/pieces.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(Pieces, AreNumberedByTheirFirstVertices) {
    // 5-1-3 and 0-4-6 are triangles, 2 is alone, and 6-7-8 joins the second.
    const Topology topology{9, {{5, 1, 3}, {0, 4, 6}, {6, 7, 8}}};
    const Pieces pieces = connected_pieces(topology);
    EXPECT_EQ(pieces.count, 3u);
    EXPECT_EQ(pieces.of_vertex, (std::vector<uint32_t>{0, 1, 2, 1, 0, 1, 0, 0, 0}));
    EXPECT_EQ(pieces.num_vertices, (std::vector<uint32_t>{5, 3, 1}));
}

TEST(Pieces, OfALongStripAreOne) {
    Topology strip{100'000, {}};
    for (uint32_t v = 0; v + 2 < strip.num_vertices; ++v)
        strip.triangles.push_back({v + 2, v + 1, v});
    EXPECT_EQ(connected_pieces(strip).count, 1u);
    EXPECT_EQ(connected_pieces({}).count, 0u);
}

}  // namespace
}  // namespace paim
