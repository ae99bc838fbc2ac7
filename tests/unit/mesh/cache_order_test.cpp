// The local order of vertices and triangles: the same mesh, and the same order for everybody.
#include "paim/mesh/cache_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace paim {
namespace {

// A sheet of n · n vertices that are numbered without order, and two vertices of no triangle.
Topology scattered_sheet(uint32_t n) {
    const uint32_t count = n * n + 2;
    const auto number = [&](uint32_t x, uint32_t y) { return ((y * n + x) * 61 + 7) % count; };
    Topology topology;
    topology.num_vertices = count;
    for (uint32_t y = 0; y + 1 < n; ++y) {
        for (uint32_t x = 0; x + 1 < n; ++x) {
            const uint32_t a = number(x, y), b = number(x + 1, y), c = number(x, y + 1),
                           d = number(x + 1, y + 1);
            topology.triangles.push_back({a, b, d});
            topology.triangles.push_back({a, d, c});
        }
    }
    return topology;
}

Triangle turned(Triangle t) {
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
}

std::vector<Triangle> sorted(std::vector<Triangle> triangles) {
    std::transform(triangles.begin(), triangles.end(), triangles.begin(), turned);
    std::sort(triangles.begin(), triangles.end());
    return triangles;
}

double mean_edge(const Topology& topology) {
    double sum = 0.0;
    for (const Triangle& t : topology.triangles) {
        for (size_t j = 0; j < 3; ++j) {
            sum += std::abs(static_cast<double>(t[j]) - static_cast<double>(t[(j + 1) % 3]));
        }
    }
    return sum / (3.0 * static_cast<double>(topology.triangles.size()));
}

TEST(Locality, IsTheSameMesh) {
    const Topology mesh = scattered_sheet(20);
    const CacheOrder order = cache_order(mesh);
    ASSERT_EQ(order.topology.num_vertices, mesh.num_vertices);
    std::vector<uint32_t> all = order.old_vertex;
    std::sort(all.begin(), all.end());
    std::vector<uint32_t> expected(mesh.num_vertices);
    std::iota(expected.begin(), expected.end(), 0u);
    EXPECT_EQ(all, expected);
    std::vector<Triangle> back = order.topology.triangles;
    for (Triangle& t : back) {
        for (uint32_t& v : t) v = order.old_vertex[v];
    }
    // Turned, not mirrored.
    EXPECT_EQ(sorted(back), sorted(mesh.triangles));
    EXPECT_EQ(cache_order(mesh).old_vertex, order.old_vertex);
}

TEST(Locality, BringsNeighboursTogether) {
    const Topology mesh = scattered_sheet(40);
    // Rows of a sheet are 40 apart; the scattered numbers a third of all 1602.
    EXPECT_GT(mean_edge(mesh), 150.0);
    EXPECT_LT(mean_edge(cache_order(mesh).topology), 60.0);
}

TEST(Locality, PutsVerticesWithoutTrianglesLast) {
    Topology mesh = scattered_sheet(20);
    std::vector<bool> used(mesh.num_vertices, false);
    for (const Triangle& t : mesh.triangles) {
        for (const uint32_t v : t) used[v] = true;
    }
    std::vector<uint32_t> alone;
    for (uint32_t v = 0; v < mesh.num_vertices; ++v) {
        if (!used[v]) alone.push_back(v);
    }
    ASSERT_EQ(alone.size(), 2u);
    const CacheOrder order = cache_order(mesh);
    EXPECT_EQ(std::vector(order.old_vertex.end() - 2, order.old_vertex.end()), alone);
}

TEST(Locality, OfNoTrianglesIsNoChange) {
    for (const uint32_t count : {0u, 1u, 5u}) {
        const CacheOrder order = cache_order({count, {}});
        ASSERT_EQ(order.old_vertex.size(), count);
        for (uint32_t v = 0; v < count; ++v) EXPECT_EQ(order.old_vertex[v], v);
        EXPECT_TRUE(order.topology.triangles.empty());
    }
}

// A floor is such a piece. Vertices of no triangle go behind it.
TEST(Locality, KeepsALastPieceLast) {
    Topology mesh = scattered_sheet(7);
    const uint32_t first = mesh.num_vertices;
    const size_t num_triangles = mesh.triangles.size();
    mesh.append(scattered_sheet(20));
    const CacheOrder order = cache_order(mesh);
    EXPECT_EQ(order.topology.num_triangles_before(7 * 7), num_triangles);
    EXPECT_EQ(new_number_of_first(first, order.old_vertex), 7u * 7u);
    EXPECT_EQ(new_number_of_first(mesh.num_vertices, order.old_vertex), kAllVertices);
}

// Triangles that name a vertex twice are kept: the model has as many as the bake.
TEST(Locality, KeepsDegenerateTriangles) {
    const Topology mesh{4, {{1, 1, 2}, {3, 3, 3}, {0, 1, 2}}};
    const CacheOrder order = cache_order(mesh);
    std::vector<Triangle> back = order.topology.triangles;
    for (Triangle& t : back) {
        for (uint32_t& v : t) v = order.old_vertex[v];
    }
    EXPECT_EQ(sorted(back), sorted(mesh.triangles));
}

}  // namespace
}  // namespace paim
