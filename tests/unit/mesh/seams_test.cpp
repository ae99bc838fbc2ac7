// Seams: which vertices share normals, and which only lie at the same place.
#include "paim/mesh/seams.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "paim/mesh/normals.h"
#include "paim/mesh/places.h"
#include "paim/mesh/pose_set.h"
#include "poses/shapes.h"

namespace paim {
namespace {

struct Mesh {
    Topology topology;
    std::vector<Vec3f> positions;

    // A quad of two triangles on vertices of its own.
    void add_quad(const Vec3f& a, const Vec3f& b, const Vec3f& c, const Vec3f& d) {
        const uint32_t n = topology.num_vertices;
        positions.insert(positions.end(), {a, b, c, d});
        topology.num_vertices += 4;
        topology.triangles.insert(topology.triangles.end(), {{n, n + 1, n + 2}, {n, n + 2, n + 3}});
    }
    std::vector<uint32_t> seams() const {
        return find_seams(topology, first_at_position(positions), positions);
    }
};

// An axis-aligned box of six quads that share no vertices.
void add_box(Mesh& mesh, const Vec3f& low, const Vec3f& high) {
    const auto corner = [&](int i) {
        return Vec3f(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                     i & 4 ? high.z() : low.z());
    };
    for (const auto& [a, b, c, d] : std::vector<std::array<int, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh.add_quad(corner(a), corner(b), corner(c), corner(d));
    }
}

TEST(Seams, ABoxOfSeparateQuadsHasTheNormalsOfOneWithEightVertices) {
    Mesh box;
    add_box(box, {-1, -1, -1}, {1, 1, 1});
    const PoseSet set(box.topology, {box.positions});
    const Pose pose = set.load_pose(0);
    for (size_t v = 0; v < 24; ++v) {
        EXPECT_LT((pose.normals[v] - box.positions[v].normalized()).norm(), 1e-6f) << v;
    }
}

TEST(Seams, DoNotDependOnTheOrderOfFaces) {
    Mesh box;
    add_box(box, {-1, -1, -1}, {1, 1, 1});
    const auto seams = box.seams();
    std::reverse(box.topology.triangles.begin(), box.topology.triangles.end());
    EXPECT_EQ(box.seams(), seams);
    EXPECT_EQ(seams[box.topology.num_vertices - 1] < 24, true);
}

TEST(Seams, SpheresThatAreCutIntoTheirTrianglesHaveTheNormalsOfWholeOnes) {
    const auto sphere = poses::make_sphere_sequence(162);
    const std::vector<Vec3f> whole = sphere->positions(0, 1);
    const auto expected = vertex_normals(sphere->topology(), whole);
    Mesh cut;
    std::vector<uint32_t> origin;  // in the whole one
    for (const Triangle& t : sphere->topology().triangles) {
        const uint32_t n = cut.topology.num_vertices;
        cut.topology.triangles.push_back({n, n + 1, n + 2});
        cut.topology.num_vertices += 3;
        for (const uint32_t v : t) {
            cut.positions.push_back(whole[v]);
            origin.push_back(v);
        }
    }
    const auto normals = vertex_normals(cut.topology, cut.positions, cut.seams());
    for (size_t v = 0; v < origin.size(); ++v) {
        // Sums in another order.
        EXPECT_LT((normals[v] - expected[origin[v]]).norm(), 2e-7f);
    }
}

TEST(Seams, ArePlacesSharedInEveryPose) {
    // Two quads side by side on vertices of their own. In the second pose the right one moves off.
    Mesh mesh;
    mesh.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    mesh.add_quad({1, 0, 0}, {1, 0, -1}, {1, 1, -1}, {1, 1, 0});
    std::vector<Vec3f> moved = mesh.positions;
    for (size_t v = 4; v < 8; ++v) moved[v] += Vec3f(0, 0, -1);
    std::vector<Vec3f> bent = mesh.positions;  // together, both edges move
    for (const size_t v : {1, 2, 4, 7}) bent[v] += Vec3f(0.5f, 0, 0.25f);
    const Vec3f both = Vec3f(1, 0, 1).normalized();
    const auto normal = [&](const std::vector<std::vector<Vec3f>>& poses) {
        return PoseSet(mesh.topology, poses).load_pose(0).normals[1];
    };
    EXPECT_LT((normal({mesh.positions}) - both).norm(), 1e-6f);
    EXPECT_LT((normal({mesh.positions, bent}) - both).norm(), 1e-6f);
    EXPECT_LT((normal({mesh.positions, moved}) - Vec3f(0, 0, 1)).norm(), 1e-6f);
    EXPECT_LT((normal({mesh.positions, bent, moved}) - Vec3f(0, 0, 1)).norm(), 1e-6f);
}

// A flat sheet of two halves. In the first pose a vertex of one half is far away in the plane of the
// sheet, so that its faces there lie back to back with those of the other.
TEST(Seams, AreNotPartedByOutliers) {
    for (const size_t bad : {0, 1, 5}) {  // far from the seam, and on it
        Mesh sheet;
        for (int j = 0; j < 8; ++j) {
            const auto y = static_cast<float>(j);
            sheet.add_quad({-1, y, 0}, {0, y, 0}, {0, y + 1, 0}, {-1, y + 1, 0});
            sheet.add_quad({0, y, 0}, {1, y, 0}, {1, y + 1, 0}, {0, y + 1, 0});
        }
        std::vector<Vec3f> bent = sheet.positions, broken = bent;
        for (Vec3f& x : bent) x.z() = std::abs(x.x());
        broken[bad] += Vec3f(7000, 100, 0);
        const auto expected = PoseSet(sheet.topology, {bent, bent, bent, bent}).load_pose(3);
        for (size_t p = 0; p < 4; ++p) {
            std::vector<std::vector<Vec3f>> poses(4, bent);
            poses[p] = broken;
            const Pose got = PoseSet(sheet.topology, poses).load_pose(p == 3 ? 2 : 3);
            for (size_t v = 0; v < bent.size(); ++v) {
                EXPECT_EQ(got.normals[v], expected.normals[v]) << bad << ' ' << p << ' ' << v;
            }
        }
    }
}

TEST(Seams, AreNotWhereSurfacesOnlyTouch) {
    // The two sides of a card, cut along the same diagonal and along the other.
    for (const bool other_diagonal : {false, true}) {
        Mesh card;
        card.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
        if (other_diagonal) {
            card.add_quad({1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {1, 1, 0});
        } else {
            card.add_quad({0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0});
        }
        EXPECT_TRUE(card.seams().empty());
    }
    // The same side twice.
    Mesh twice;
    twice.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    twice.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    EXPECT_TRUE(twice.seams().empty());
    // Two quads that meet in one corner, and three along an edge.
    Mesh corner;
    corner.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    corner.add_quad({1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0});
    EXPECT_TRUE(corner.seams().empty());
    Mesh three;
    three.add_quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    three.add_quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0});
    three.add_quad({1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0});
    EXPECT_TRUE(three.seams().empty());
}

TEST(Seams, OfTwoBoxesOnEachOtherStayWithinEach) {
    Mesh boxes;
    add_box(boxes, {-1, -1, -1}, {1, 1, 1});
    add_box(boxes, {-1, 1, -1}, {1, 3, 1});
    const auto seams = boxes.seams();
    ASSERT_EQ(seams.size(), 48u);
    for (uint32_t v = 0; v < 24; ++v) EXPECT_LT(seams[v], 24u);
    for (uint32_t v = 24; v < 48; ++v) EXPECT_GE(seams[v], 24u);
}

}  // namespace
}  // namespace paim
