// Vertex normals: closed forms, scale independence, and meshes without area.
#include "paim/mesh/normals.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

TEST(VertexNormals, AverageOfUnitFaceNormals) {
    // Two faces meeting at a right angle, one ten times the other's size: the average of their unit
    // normals is the diagonal whatever their areas.
    const Topology topology{4, {{0, 1, 2}, {0, 3, 1}}};
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 10, 0}, {0, 0, 1}};
    const auto normals = vertex_normals(topology, positions);
    // Face 0 faces +z; face 1 (0,3,1) faces z × x = +y.
    const Vec3f diagonal = Vec3f(0, 1, 1).normalized();
    EXPECT_LT((normals[0] - diagonal).norm(), 1e-6f);
    EXPECT_LT((normals[1] - diagonal).norm(), 1e-6f);
    EXPECT_LT((normals[2] - Vec3f(0, 0, 1)).norm(), 1e-6f);
    EXPECT_LT((normals[3] - Vec3f(0, 1, 0)).norm(), 1e-6f);
}

TEST(VertexNormals, DoNotDependOnScale) {
    const Topology topology{3, {{0, 1, 2}}};
    for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f}) {
        const std::vector<Vec3f> positions{{0, 0, 0}, {scale, 0, 0}, {0, scale, 0}};
        for (const Vec3f& n : vertex_normals(topology, positions)) {
            EXPECT_LT((n - Vec3f(0, 0, 1)).norm(), 1e-6f) << scale;
        }
    }
}

TEST(VertexNormals, AreZeroWithoutArea) {
    // A needle, an isolated vertex, and a face glued to its own back.
    const Topology topology{8, {{0, 1, 2}, {4, 5, 6}, {4, 6, 5}}};
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5},
                                       {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 9, 9}};
    const auto normals = vertex_normals(topology, positions);
    for (const Vec3f& normal : normals) EXPECT_TRUE(normal.isZero(0.0f));
}

}  // namespace
}  // namespace paim
