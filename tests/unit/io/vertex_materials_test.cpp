// The material of each vertex: angles decide.
#include "compressor/io/vertex_materials.h"

#include <gtest/gtest.h>

namespace paim {
namespace {

using Numbers = std::vector<uint16_t>;

// A fan round vertex 0 whose corners there are 90°, 60° and 30°.
const std::vector<Vec3f> kFan{{0, 0, 0},  {1, 0, 0}, {0, 1, 0}, {-0.8660254f, 0.5f, 0},
                              {-1, 0, 0}, {9, 9, 9}};
const Topology kFaces{6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}};

TEST(VertexMaterials, TheLargestSumOfAnglesDecides) {
    // Vertex 0 has 90° of material 1 and 60° + 30° of material 2, which is the same to rounding: the
    // first face counts.
    EXPECT_EQ(materials_of_vertices(kFaces, kFan, Numbers{1, 2, 2}), (Numbers{1, 1, 2, 2, 2, 0}));
    EXPECT_EQ(materials_of_vertices(kFaces, kFan, Numbers{2, 1, 1}), (Numbers{2, 2, 1, 1, 1, 0}));
    // 90° + 30° against 60°, and 90° against 60° against 30°.
    EXPECT_EQ(materials_of_vertices(kFaces, kFan, Numbers{3, 1, 3})[0], 3);
    EXPECT_EQ(materials_of_vertices(kFaces, kFan, Numbers{0, 5, 4})[0], 0);
    // Number of faces and their order do not count: a degree less of the first is enough.
    std::vector<Vec3f> wider = kFan;
    wider[1] = Vec3f(1, 0.0175f, 0);
    EXPECT_EQ(materials_of_vertices(kFaces, wider, Numbers{1, 2, 2})[0], 2);
}

TEST(VertexMaterials, IsOneNumberWhereAllFacesAgree) {
    EXPECT_EQ(materials_of_vertices(kFaces, kFan, Numbers{7, 7, 7}), Numbers{7});
    EXPECT_EQ(materials_of_vertices(Topology{6, {}}, kFan, {}), Numbers{0});
}

}  // namespace
}  // namespace paim
