// Transfer of meshes that are odd, against what physics says of each (docs/geometry.md).
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "compressor/bake/transfer_baker.h"
#include "paim/mesh/mesh_report.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/pose_set.h"
#include "paim/sh/basis.h"
#include "paim/sh/cosine_lobe.h"
#include "poses/shapes.h"

namespace paim {
namespace {

constexpr uint32_t kBands = 5;
constexpr size_t kCoefficients = kBands * kBands;
const double kY00 = std::sqrt(0.25 / kPi);

BakedPose bake(const PoseSet& set, uint32_t rays = 256) {
    return TransferBaker({kBands, rays, 3}).bake(set.topology(), set.load_pose(0), 0);
}

PoseReport report(const PoseSet& set) {
    return report_pose(set.topology(), set.load_pose(0).positions);
}

// A vertex that nothing shadows: the cosine lobe round this normal, rounded to float.
void expect_lobe(const BakedPose& baked, size_t v, const Vec3d& normal) {
    const size_t num_vertices = baked.transfer.size() / kCoefficients;
    std::vector<double> y(kCoefficients);
    sh::evaluate_basis(static_cast<int>(kBands), normal, std::span(y));
    for (size_t i = 0; i < kCoefficients; ++i) {
        const double expected = sh::cosine_lobe(sh::band_of(static_cast<int>(i))) * y[i];
        // Half an ulp of values below 1, and what the rounding of the normal (2^-24) makes of it:
        // four bands up, the basis changes four times as fast.
        EXPECT_NEAR(baked.transfer[i * num_vertices + v], expected, 0x1p-25 + 4 * 0x1p-24)
            << v << ' ' << i;
    }
}

void expect_dark(const BakedPose& baked, size_t v) {
    const size_t num_vertices = baked.transfer.size() / kCoefficients;
    for (size_t i = 0; i < kCoefficients; ++i) {
        EXPECT_EQ(baked.transfer[i * num_vertices + v], 0.0f) << v << ' ' << i;
    }
}

struct Mesh {
    Topology topology;
    std::vector<Vec3f> positions;

    Mesh() = default;
    Mesh(Topology faces, std::vector<Vec3f> points)
        : topology(std::move(faces)), positions(std::move(points)) {}

    PoseSet pose_set() const { return {topology, {positions}}; }

    // The faces again, on vertices of their own at the same places; turned round if asked.
    Mesh with_copy(bool flipped) const {
        Mesh both = *this;
        for (Triangle t : topology.triangles) {
            for (uint32_t& v : t) v += topology.num_vertices;
            if (flipped) std::swap(t[1], t[2]);
            both.topology.triangles.push_back(t);
        }
        both.topology.num_vertices *= 2;
        both.positions.insert(both.positions.end(), positions.begin(), positions.end());
        return both;
    }
};

Mesh mesh_of(const poses::Sequence& sequence) {
    return {sequence.topology(), sequence.positions(0, 1)};
}

// A square in the plane z = 0, seen from +z, of n² cells.
Mesh square(uint32_t n) {
    Mesh mesh;
    mesh.topology.num_vertices = (n + 1) * (n + 1);
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i <= n; ++i) {
            mesh.positions.emplace_back(static_cast<float>(i), static_cast<float>(j), 0.0f);
            if (i == n || j == n) continue;
            const uint32_t v = j * (n + 1) + i;
            mesh.topology.triangles.push_back({v, v + 1, v + n + 2});
            mesh.topology.triangles.push_back({v, v + n + 2, v + n + 1});
        }
    }
    return mesh;
}

TEST(OddMesh, OneTriangleIsTheCosineLobeOnItsLitSide) {
    // In planes of no particular direction, for rounding; needles too.
    for (const float height : {1.0f, 1e-3f, 1e-6f}) {
        const Mesh mesh({3, {{0, 1, 2}}},
                        {{0.3f, 1, 2}, {1.4f, 1.3f, 1.7f}, {0.3f, 1.0f + height, 2.2f}});
        const PoseSet set = mesh.pose_set();
        const BakedPose baked = bake(set, 4096);
        EXPECT_EQ(baked.statistics.occluded, 0u) << height;
        const Vec3d normal = face_normal(mesh.positions[0], mesh.positions[1], mesh.positions[2]);
        for (size_t v = 0; v < 3; ++v) expect_lobe(baked, v, normal);
        EXPECT_EQ(report_topology(mesh.topology).boundary_edges, 3u);
    }
}

TEST(OddMesh, OpenSheetIsLitOnItsFront) {
    const Mesh sheet = square(6);
    const BakedPose baked = bake(sheet.pose_set());
    for (size_t v = 0; v < sheet.positions.size(); ++v) expect_lobe(baked, v, Vec3d(0, 0, 1));
    EXPECT_EQ(report_topology(sheet.topology).boundary_edges, 24u);
}

TEST(OddMesh, ZeroAreaFacesChangeNothing) {
    // On a sphere: a face on one point, one along an edge, one whose corners lie on a line through
    // a new vertex far outside, and one that is a needle through the air.
    const Mesh sphere = mesh_of(*poses::make_sphere_sequence(162));
    Mesh odd = sphere;
    const Triangle& t = sphere.topology.triangles[5];
    const uint32_t n = odd.topology.num_vertices;
    odd.positions.push_back(odd.positions[t[0]]);
    odd.positions.push_back(8.0f * odd.positions[t[0]]);
    odd.positions.push_back(4.0f * odd.positions[t[0]]);
    odd.topology.num_vertices += 3;
    for (const Triangle& face : {Triangle{t[0], n, t[0]}, Triangle{t[0], t[1], t[1]},
                                 Triangle{t[0], n, t[1]}, Triangle{t[0], n + 1, n + 2}}) {
        odd.topology.triangles.push_back(face);
    }
    EXPECT_EQ(report(odd.pose_set()).zero_area_faces, 4u);
    const BakedPose plain = bake(sphere.pose_set()), baked = bake(odd.pose_set());
    EXPECT_EQ(baked.statistics.occluded, 0u);
    for (size_t i = 0; i < kCoefficients; ++i) {
        for (size_t v = 0; v < n; ++v) {
            EXPECT_EQ(baked.transfer[i * (n + 3) + v], plain.transfer[i * n + v]);
        }
    }
    // The new vertices have no other faces and so no normal.
    EXPECT_EQ(baked.statistics.zero_normals, 3u);
    for (size_t v = n; v < n + 3; ++v) expect_dark(baked, v);
}

TEST(OddMesh, IsolatedVerticesAreDarkAndCastNoShadow) {
    Mesh sheet = square(4);
    sheet.positions.emplace_back(2.0f, 2.0f, 1.0f);
    ++sheet.topology.num_vertices;
    const BakedPose baked = bake(sheet.pose_set());
    for (size_t v = 0; v < 25; ++v) expect_lobe(baked, v, Vec3d(0, 0, 1));
    expect_dark(baked, 25);
    EXPECT_EQ(report_topology(sheet.topology).isolated_vertices, 1u);
    EXPECT_EQ(baked.statistics.zero_normals, 1u);
}

TEST(OddMesh, DuplicateFacesChangeNothing) {
    // Of a bowl, which shadows itself: some faces twice, some with their backs.
    const Mesh bowl = mesh_of(*poses::make_bowl_sequence(300));
    Mesh odd = bowl;
    const size_t num_faces = bowl.topology.triangles.size();
    for (size_t f = 0; f < num_faces; f += 3) {
        Triangle t = bowl.topology.triangles[f];
        if (f % 2 == 0) std::swap(t[0], t[1]);
        odd.topology.triangles.push_back({t[1], t[2], t[0]});
    }
    const TopologyReport counts = report_topology(odd.topology);
    EXPECT_EQ(counts.duplicate_faces + counts.back_faces, (num_faces + 2) / 3);
    EXPECT_EQ(counts.boundary_edges, report_topology(bowl.topology).boundary_edges);
    EXPECT_EQ(counts.flipped_edges + counts.non_manifold_edges, 0u);
    const BakedPose plain = bake(bowl.pose_set()), baked = bake(odd.pose_set());
    EXPECT_TRUE(baked.transfer == plain.transfer);
}

TEST(OddMesh, AFaceWithItsOwnBackIsLitOnTheSideOfTheFirst) {
    Mesh mesh = square(3);
    const auto front = mesh.topology.triangles;
    for (const Triangle& t : front) mesh.topology.triangles.push_back({t[0], t[2], t[1]});
    const BakedPose baked = bake(mesh.pose_set());
    for (size_t v = 0; v < 16; ++v) expect_lobe(baked, v, Vec3d(0, 0, 1));
    EXPECT_EQ(report_topology(mesh.topology).back_faces, front.size());
}

TEST(OddMesh, CoincidentShellsDoNotShadowEachOther) {
    // Two spheres in the same place, both facing outwards.
    const Mesh sphere = mesh_of(*poses::make_sphere_sequence(600));
    const Mesh both = sphere.with_copy(false);
    EXPECT_EQ(report(both.pose_set()).coincident_faces, sphere.topology.triangles.size());
    const BakedPose baked = bake(both.pose_set());
    EXPECT_EQ(baked.statistics.occluded, 0u);
    const Pose pose = both.pose_set().load_pose(0);
    for (size_t v = 0; v < both.positions.size(); v += 7) {
        expect_lobe(baked, v, pose.normals[v].cast<double>().normalized());
    }
}

TEST(OddMesh, AShellWithAFlippedCopyIsLitOutsideAndDarkInside) {
    const Mesh sphere = mesh_of(*poses::make_sphere_sequence(600));
    const Mesh both = sphere.with_copy(true);
    EXPECT_EQ(report(both.pose_set()).coincident_faces, sphere.topology.triangles.size());
    const BakedPose baked = bake(both.pose_set());
    const size_t n = sphere.positions.size();
    const Pose pose = both.pose_set().load_pose(0);
    for (size_t v = 0; v < n; v += 7) {
        expect_lobe(baked, v, pose.normals[v].cast<double>().normalized());
    }
    for (size_t v = n; v < 2 * n; ++v) expect_dark(baked, v);
}

TEST(OddMesh, ASheetWithAFlippedCopyIsLitOnBothSides) {
    const Mesh both = square(4).with_copy(true);
    const BakedPose baked = bake(both.pose_set());
    EXPECT_EQ(baked.statistics.occluded, 0u);
    for (size_t v = 0; v < 25; ++v) {
        expect_lobe(baked, v, Vec3d(0, 0, 1));
        expect_lobe(baked, 25 + v, Vec3d(0, 0, -1));
    }
}

TEST(OddMesh, FlippedNeighboursKeepTheirSides) {
    // A strip of two quads, the right one turned round. Where both meet, the side of the larger
    // angle wins.
    const Mesh strip{{6, {{0, 1, 4}, {0, 4, 3}, {1, 5, 2}, {1, 4, 5}}},
                     {{0, 0, 0}, {1, 0, 0}, {2, -1, 0}, {0, 1, 0}, {1, 1, 0}, {2, 2, 0}}};
    EXPECT_EQ(report_topology(strip.topology).flipped_edges, 1u);
    const BakedPose baked = bake(strip.pose_set());
    for (const size_t v : {0u, 3u}) expect_lobe(baked, v, Vec3d(0, 0, 1));
    for (const size_t v : {2u, 5u}) expect_lobe(baked, v, Vec3d(0, 0, -1));
    // On the left a right angle, on the right half a one more.
    expect_lobe(baked, 1, Vec3d(0, 0, -1));
    expect_lobe(baked, 4, Vec3d(0, 0, -1));
    // Where angles are equal the normals cancel: no side is left, and the vertex is dark and
    // counted.
    const Mesh two{{4, {{0, 1, 2}, {1, 2, 3}}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}};
    EXPECT_EQ(report_topology(two.topology).flipped_edges, 1u);
    const BakedPose cancelled = bake(two.pose_set());
    EXPECT_EQ(cancelled.statistics.zero_normals, 2u);
    expect_lobe(cancelled, 0, Vec3d(0, 0, 1));
    expect_dark(cancelled, 1);
    expect_dark(cancelled, 2);
    expect_lobe(cancelled, 3, Vec3d(0, 0, -1));
}

TEST(OddMesh, NonManifoldEdgesShadowAsTheyShould) {
    // An upright unit square on the middle line of the ground: three faces at its foot. At the foot
    // it hides no more than half the ground's sky (its normal bisects nothing there: two ground
    // faces against one).
    Mesh mesh = square(2);
    const uint32_t n = mesh.topology.num_vertices;
    mesh.positions.emplace_back(0.0f, 1.0f, 2.0f);
    mesh.positions.emplace_back(2.0f, 1.0f, 2.0f);
    mesh.topology.num_vertices += 2;
    mesh.topology.triangles.push_back({3, 4, n});
    mesh.topology.triangles.push_back({4, n + 1, n});
    mesh.topology.triangles.push_back({4, 5, n + 1});
    EXPECT_EQ(report_topology(mesh.topology).non_manifold_edges, 2u);
    const BakedPose baked = bake(mesh.pose_set(), 1 << 14);
    // Point (1, 0) of the ground, at distance 1 from the middle of a wall of half width 1 and
    // height 2: form factor of a perpendicular rectangle (Howell, B-3), twice:
    //   F = 2 · 1/(2π) (atan(1/Y) − Y/√(X²+Y²) atan(1/√(X²+Y²))),
    //   X = height / b, Y = distance / b, b = 1.
    const double x = 2.0, y = 1.0, r = std::hypot(x, y);
    const double factor = (std::atan(1.0 / y) - y / r * std::atan(1.0 / r)) / kPi;
    // A disc cut by lines: N^-3/4 of 8192 points is 1.2e-3 a half, three of these over √2.
    EXPECT_NEAR(baked.transfer[1] / kY00, 1.0 - factor, 2.5e-3);
    EXPECT_NEAR(baked.transfer[7] / kY00, 1.0 - factor, 2.5e-3);
}

}  // namespace
}  // namespace paim
