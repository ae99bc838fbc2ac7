// Closed parts that face inwards, and those that rightly do.
#include "paim/mesh/orientation.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "poses/shapes.h"

namespace paim {
namespace {

struct Mesh {
    Topology topology;
    std::vector<Vec3f> positions;

    Mesh& add_sphere(float radius, const Vec3f& centre, bool inward) {
        const auto sphere = poses::make_sphere_sequence(50);
        Topology faces = sphere->topology();
        if (inward) {
            std::vector<uint32_t> all(faces.triangles.size());
            std::iota(all.begin(), all.end(), 0u);
            turn_triangles(all, faces);
        }
        topology.append(faces);
        for (const Vec3f& x : sphere->positions(0, 1)) positions.push_back(radius * x + centre);
        return *this;
    }
    std::vector<uint32_t> inward() const {
        std::vector<uint32_t> first;
        for (const auto& part : find_inward_parts(topology, {&positions, 1})) {
            first.push_back(part.first_vertex);
        }
        return first;
    }
};

using Vertices = std::vector<uint32_t>;

TEST(Orientation, ClosedPartsThatFaceInwardsAreFoundAndTurned) {
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        Mesh mesh;
        mesh.add_sphere(scale, {0, 0, 0}, false)
            .add_sphere(scale, {5 * scale, 0, 0}, true)
            .add_sphere(scale, {0, 9 * scale, 0}, false)
            .add_sphere(0.1f * scale, {0, 0, 40 * scale}, true);
        EXPECT_EQ(mesh.inward(), (Vertices{42, 126}));
        const Topology before = mesh.topology;
        for (const InwardPart& part : find_inward_parts(mesh.topology, {&mesh.positions, 1})) {
            EXPECT_EQ(part.triangles.size(), 80u);
            turn_triangles(part.triangles, mesh.topology);
        }
        EXPECT_TRUE(mesh.inward().empty());
        EXPECT_FALSE(mesh.topology == before);
    }
}

TEST(Orientation, WallsOfCavitiesFaceTheirInside) {
    Mesh hollow;  // an outer wall, a cavity, a ball in the cavity that faces inwards
    hollow.add_sphere(4, {0, 0, 0}, false).add_sphere(2, {1, 0, 0}, true);
    EXPECT_TRUE(hollow.inward().empty());
    hollow.add_sphere(0.5f, {1, 0, 0}, true);
    EXPECT_EQ(hollow.inward(), (Vertices{84}));
    // All inside out: only the outer wall is known to be wrong. Within another's bounds but not
    // inside it, a part is on its own.
    Mesh inside_out;
    inside_out.add_sphere(4, {0, 0, 0}, true).add_sphere(2, {1, 0, 0}, false);
    inside_out.add_sphere(0.2f, {3.7f, 3.7f, 3.7f}, true);
    EXPECT_EQ(inside_out.inward(), (Vertices{0, 84}));
}

TEST(Orientation, OpenFlatAndTangledPartsAreNotJudged) {
    Mesh open;
    open.add_sphere(1, {0, 0, 0}, true);
    open.topology.triangles.pop_back();
    EXPECT_TRUE(open.inward().empty());
    Mesh tangled;  // one face the other way round
    tangled.add_sphere(1, {0, 0, 0}, true);
    turn_triangles(Vertices{7}, tangled.topology);
    EXPECT_TRUE(tangled.inward().empty());
    Mesh flat;
    flat.add_sphere(1, {0, 0, 0}, true);
    for (Vec3f& x : flat.positions) x.z() = 0.0f;
    EXPECT_TRUE(flat.inward().empty());
    Mesh point;
    point.add_sphere(0, {1, 2, 3}, true);
    EXPECT_TRUE(point.inward().empty());
}

TEST(Orientation, PartsThatAreCutAlongSeamsAreClosed) {
    Mesh whole;
    whole.add_sphere(1, {0, 0, 0}, true);
    Mesh cut;  // into its triangles
    for (const Triangle& t : whole.topology.triangles) {
        const uint32_t n = cut.topology.num_vertices;
        cut.topology.triangles.push_back({n, n + 1, n + 2});
        cut.topology.num_vertices += 3;
        for (const uint32_t v : t) cut.positions.push_back(whole.positions[v]);
    }
    const auto parts = find_inward_parts(cut.topology, {&cut.positions, 1});
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(parts[0].triangles.size(), 80u);
    // Two of them side by side share places, not edges.
    Mesh two = cut;
    two.topology.append(cut.topology);
    for (const Vec3f& x : cut.positions) two.positions.push_back(x + Vec3f(2, 0, 0));
    EXPECT_EQ(two.inward(), (Vertices{0, 240}));
}

using Poses = std::vector<std::vector<Vec3f>>;

size_t num_inward(const Mesh& mesh, const Poses& poses) {
    return find_inward_parts(mesh.topology, poses).size();
}

// These vertices are pulled through the origin, which turns volumes.
std::vector<Vec3f> broken(const Mesh& mesh, const Vertices& vertices, float factor = -5000.0f) {
    std::vector<Vec3f> positions = mesh.positions;
    for (const uint32_t v : vertices) positions[v] *= factor;
    return positions;
}

TEST(Orientation, IsThatOfMostPoses) {
    Mesh right;
    right.add_sphere(1, {0, 0, 0}, false).add_sphere(0.5f, {0, 0, 0}, true);
    Mesh wrong;
    wrong.add_sphere(1, {0, 0, 0}, true);
    Mesh turned = wrong;
    turn_triangles(find_inward_parts(wrong.topology, {&wrong.positions, 1})[0].triangles,
                   turned.topology);
    // All of a part, which no pose by itself can notice.
    const auto mirrored = [](const Mesh& mesh) {
        std::vector<Vec3f> positions = mesh.positions;
        for (Vec3f& x : positions) x.x() *= -1.0f;
        return positions;
    };
    for (size_t p = 0; p < 3; ++p) {
        Poses poses(3, turned.positions);
        poses[p] = mirrored(turned);
        EXPECT_EQ(num_inward(turned, poses), 0u) << p;
        poses.assign(3, wrong.positions);
        poses[p] = mirrored(wrong);
        EXPECT_EQ(num_inward(wrong, poses), 1u) << p;
    }
    // Flat in the first pose: not judged. Flat in the others: by the first.
    std::vector<Vec3f> flat = wrong.positions;
    for (Vec3f& x : flat) x.z() = 0.0f;
    EXPECT_EQ(num_inward(wrong, {flat, wrong.positions, wrong.positions}), 0u);
    EXPECT_EQ(num_inward(wrong, {wrong.positions, flat, flat}), 1u);
}

TEST(Orientation, IsNotDecidedByOutliers) {
    Mesh right;  // with a cavity
    right.add_sphere(1, {0, 0, 0}, false).add_sphere(0.5f, {0, 0, 0}, true);
    Mesh wrong;
    wrong.add_sphere(1, {0, 0, 0}, true);
    // A vertex of the outer wall, the first one of the cavity's wall, and several, of which some are
    // neighbours.
    for (const Vertices& vertices :
         {Vertices{0}, Vertices{5}, Vertices{42}, Vertices{0, 12, 13, 20}}) {
        for (const float factor : {-5000.0f, -20.0f, 300.0f}) {
            const std::vector<Vec3f> bad = broken(right, vertices, factor);
            EXPECT_EQ(num_inward(right, {bad}), 0u)
                << testing::PrintToString(vertices) << " " << factor;
            for (size_t good = 0; good < 3; ++good) {
                Poses poses(3, bad);
                EXPECT_EQ(num_inward(right, poses), 0u)
                    << testing::PrintToString(vertices) << " " << factor;
                poses[good] = right.positions;
                EXPECT_EQ(num_inward(right, poses), 0u)
                    << testing::PrintToString(vertices) << " " << factor;
                if (vertices[0] >= wrong.positions.size()) continue;
                poses.assign(3, broken(wrong, vertices, factor));
                poses[good] = wrong.positions;
                EXPECT_EQ(num_inward(wrong, poses), 1u)
                    << testing::PrintToString(vertices) << " " << factor;
            }
        }
    }
}

TEST(Orientation, OfSmallPartsIsNotDecidedByAnOutlier) {
    Mesh cube;
    cube.topology.num_vertices = 8;
    for (uint32_t v = 0; v < 8; ++v) {
        const auto sign = [&](uint32_t bit) { return (v & bit) == 0 ? -1.0f : 1.0f; };
        cube.positions.emplace_back(sign(1), sign(2), sign(4));
    }
    for (const auto& [a, b, c, d] : std::vector<std::array<uint32_t, 4>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        cube.topology.triangles.push_back({a, b, c});
        cube.topology.triangles.push_back({a, c, d});
    }
    Mesh inward = cube;
    Vertices all(12);
    std::iota(all.begin(), all.end(), 0u);
    turn_triangles(all, inward.topology);
    ASSERT_EQ(cube.inward(), Vertices());
    ASSERT_EQ(inward.inward(), Vertices{0});
    for (uint32_t v = 0; v < 8; ++v) {
        for (const float factor : {-5000.0f, -20.0f, -8.0f}) {
            const std::vector<Vec3f> bad = broken(cube, {v}, factor);
            EXPECT_EQ(num_inward(cube, {cube.positions, bad, bad}), 0u) << v << " " << factor;
            EXPECT_EQ(num_inward(inward, {inward.positions, bad, bad}), 1u) << v << " " << factor;
        }
    }
}

// Much of a mesh may be far from where most vertices are.
TEST(Orientation, OfPartsThatAreFinerInOnePlaceIsJudged) {
    for (const bool is_inward : {false, true}) {
        Mesh mesh;
        mesh.add_sphere(1, {0, 0, 0}, is_inward);
        // All but one side is drawn out to a long body.
        for (Vec3f& x : mesh.positions) {
            if (x.z() > 0.5f) x *= 100.0f;
        }
        EXPECT_EQ(mesh.inward().size(), is_inward ? 1u : 0u);
        // The other side is drawn together to a fine head.
        for (Vec3f& x : mesh.positions) {
            if (x.z() <= 0.5f) x *= 0.01f;
        }
        EXPECT_EQ(mesh.inward().size(), is_inward ? 1u : 0u);
    }
}

}  // namespace
}  // namespace paim
