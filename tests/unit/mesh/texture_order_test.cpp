// Textures of meshes in another order, and of two meshes as one.
#include "paim/mesh/texture_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "paim/mesh/cache_order.h"
#include "tests/grid_surface.h"

namespace paim {
namespace {

Vec2f telling(uint32_t vertex, uint32_t face) {
    return {static_cast<float>(vertex), static_cast<float>(face)};
}

// A texture whose coordinates tell the vertex (u) and the face (v), with images 1 and 2 and none.
Texture telling_texture(const Topology& topology) {
    Texture texture;
    texture.images = {{"a.png", {1, 2}}, {"b.png", {3}}};
    texture.factors = {Vec3f(1, 1, 1), Vec3f(0.5f, 0, 1)};
    for (uint32_t f = 0; f < topology.triangles.size(); ++f) {
        texture.image_of_face.push_back(static_cast<uint16_t>(f % 3));
        Triangle corners{};
        for (size_t k = 0; k < 3 && f % 3 > 0; ++k) {
            corners[k] = static_cast<uint32_t>(texture.coordinates.size());
            texture.coordinates.push_back(telling(topology.triangles[f][k], f));
        }
        texture.corners.push_back(corners);
    }
    return texture;
}

TEST(TextureOrder, CornersGoWithTheirVertices) {
    Topology topology = make_grid(9);
    // A face and its back, and one that is there twice.
    const Triangle first = topology.triangles[0];
    topology.triangles.push_back({first[0], first[2], first[1]});
    topology.triangles.push_back({first[1], first[2], first[0]});
    const Texture texture = telling_texture(topology);
    const CacheOrder order = cache_order(topology);
    ASSERT_NE(order.topology.triangles, topology.triangles);
    const Texture result = reordered(texture, topology, order.topology, order.old_vertex);
    EXPECT_EQ(result.images, texture.images);
    EXPECT_EQ(result.factors, texture.factors);
    ASSERT_EQ(result.corners.size(), topology.triangles.size());
    std::map<uint32_t, int> uses;  // of the old faces
    for (size_t f = 0; f < result.corners.size(); ++f) {
        if (result.image_of_face[f] == 0) {
            EXPECT_EQ(result.corners[f], Triangle{});
            continue;
        }
        const Triangle& t = order.topology.triangles[f];
        const auto old = static_cast<uint32_t>(result.coordinates[result.corners[f][0]].y());
        ++uses[old];
        EXPECT_EQ(result.image_of_face[f], old % 3);
        for (size_t k = 0; k < 3; ++k) {
            const Vec2f& uv = result.coordinates[result.corners[f][k]];
            EXPECT_EQ(uv, telling(order.old_vertex[t[k]], old));
        }
    }
    for (const auto& [face, count] : uses) EXPECT_EQ(count, 1) << face;
    EXPECT_EQ(result.coordinates.size(), texture.coordinates.size());
    // In the order of their use, so that new ones follow each other.
    EXPECT_EQ(std::count_if(result.corners.begin(), result.corners.end(),
                            [](const Triangle& t) {
                                return std::max({t[0], t[1], t[2]}) < 3;
                            }),
              1 + std::count(result.image_of_face.begin(), result.image_of_face.end(), 0));
}

TEST(TextureOrder, NoTextureIsNone) {
    const Topology topology = make_grid(3);
    const CacheOrder order = cache_order(topology);
    EXPECT_TRUE(reordered({}, topology, order.topology, order.old_vertex) == Texture());
}

TEST(TextureAppend, FacesWithoutImagesFill) {
    const Topology two{4, {{0, 1, 2}, {0, 2, 3}}};
    const Texture own = telling_texture(two);  // faces of image 0 and 1
    Texture texture;
    texture.append({}, 1, 2);
    EXPECT_TRUE(texture == Texture());
    texture.append(own, 3, 2);
    EXPECT_EQ(texture.image_of_face, (std::vector<uint16_t>{0, 0, 0, 0, 1}));
    EXPECT_EQ(texture.corners[3], Triangle{});
    EXPECT_EQ(texture.corners[4], own.corners[1]);
    texture.append({}, 5, 2);
    EXPECT_EQ(texture.image_of_face.size(), 7u);
    Texture other = own;
    other.images[0].bytes = {9};
    texture.append(other, 7, 2);
    ASSERT_EQ(texture.images.size(), 3u);  // b.png is there already
    EXPECT_EQ(texture.images[2].bytes, std::vector<uint8_t>{9});
    EXPECT_EQ(texture.image_of_face, (std::vector<uint16_t>{0, 0, 0, 0, 1, 0, 0, 0, 3}));
    EXPECT_EQ(texture.corners[8], (Triangle{3, 4, 5}));
    EXPECT_EQ(texture.coordinates[3], own.coordinates[0]);
    // The same image with another factor is another one.
    other.factors[0] = Vec3f(0, 1, 0);
    texture.append(other, 9, 2);
    EXPECT_EQ(texture.images.size(), 4u);
    EXPECT_EQ(texture.factors[3], Vec3f(0, 1, 0));
}

}  // namespace
}  // namespace paim
