// Vertices of faces, and those of none.
#include "paim/mesh/face_vertices.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

using Vertices = std::vector<uint32_t>;

TEST(FaceVertices, AreThoseThatAFaceNames) {
    const Topology topology{7, {{5, 1, 3}, {3, 1, 6}}};
    EXPECT_EQ(face_vertices(topology), (Vertices{1, 3, 5, 6}));
    EXPECT_EQ(isolated_vertices(topology), (Vertices{0, 2, 4}));
}

// Points without faces are all there is.
TEST(FaceVertices, AreAllWhereThereIsNoFace) {
    EXPECT_EQ(face_vertices({3, {}}), (Vertices{0, 1, 2}));
    EXPECT_TRUE(isolated_vertices({3, {}}).empty());
    EXPECT_TRUE(face_vertices({0, {}}).empty());
}

TEST(FaceVertices, HaveBoundsOfTheirOwn) {
    const std::vector<float> planes{9, 1, 2, -9, 9, 3, 5, -9, 9, -4, -6, -9};
    const Bounds bounds = bounds_of_vertices(planes, Vertices{1, 2});
    EXPECT_EQ(bounds.lower, Vec3f(1, 3, -6));
    EXPECT_EQ(bounds.upper, Vec3f(2, 5, -4));
    EXPECT_TRUE(bounds_of_vertices(planes, {}).empty());
}

TEST(FaceVertices, AreKeptPlaneByPlane) {
    std::vector<float> planes{0, 1, 2, 3, 10, 11, 12, 13};
    keep_vertices(planes, 4, Vertices{1, 3});
    EXPECT_EQ(planes, (std::vector<float>{1, 3, 11, 13}));
    keep_vertices(planes, 2, Vertices{0, 1});
    EXPECT_EQ(planes, (std::vector<float>{1, 3, 11, 13}));
    keep_vertices(planes, 2, {});
    EXPECT_TRUE(planes.empty());
}

}  // namespace
}  // namespace paim
