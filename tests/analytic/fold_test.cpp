// Transfer where faces are steep against the vertex normal: both sides of folds, tips, slits, and
// cards whose normals lie in their plane, in closed form.
//
// The vector irradiance of the directions between planes through a point is ½ Σ angle · normal over
// the planes (Lambert's formula). So if the faces round a vertex leave a region that lies within the
// hemisphere of n, its share of the light is n · Σ angle · normal / 2π.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compressor/bake/ray_start.h"
#include "compressor/bake/transfer_baker.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/pose_set.h"
#include "poses/shapes.h"

namespace paim {
namespace {

const double kY00 = std::sqrt(0.25 / kPi);

struct Mesh {
    Topology topology;
    std::vector<Vec3f> positions;
};

Mesh turned(Mesh mesh) {
    for (Triangle& t : mesh.topology.triangles) std::swap(t[1], t[2]);
    return mesh;
}

constexpr uint32_t kRays = 1 << 18;

// The share of the light that vertex v receives under an even sky.
double share(const Mesh& mesh, const Vec3f& normal, size_t v, uint32_t rays = kRays) {
    std::vector<Vec3f> normals(mesh.positions.size(), Vec3f::Zero());  // others have no rays
    normals[v] = normal;
    const BakedPose baked =
        TransferBaker({1, rays, 7}).bake(mesh.topology, {mesh.positions, normals}, 0);
    return double{baked.transfer[v]} / kY00;
}

Vec3f normal_of(const Mesh& mesh, size_t v) {
    return vertex_normals(mesh.topology, mesh.positions)[v];
}

double share(const Mesh& mesh, size_t v) {
    return share(mesh, normal_of(mesh, v), v);
}

// Triangles round vertex 0, at the origin.
Mesh cone(const std::vector<Vec3d>& rim) {
    Mesh mesh{{static_cast<uint32_t>(rim.size()) + 1, {}}, {Vec3f::Zero()}};
    for (uint32_t i = 0; i < rim.size(); ++i) {
        mesh.positions.push_back(rim[i].cast<float>());
        mesh.topology.triangles.push_back(
            {0, 1 + i, 1 + (i + 1) % static_cast<uint32_t>(rim.size())});
    }
    return mesh;
}

// Σ angle · normal / 2π over the faces of vertex 0.
double share_of_region(const Mesh& mesh) {
    Vec3d sum = Vec3d::Zero();
    for (const Triangle& t : mesh.topology.triangles) {
        const auto corner = [&](size_t i) -> const Vec3f& { return mesh.positions[t[i]]; };
        sum += corner_angles(corner(0), corner(1), corner(2))[0] *
               face_normal(corner(0), corner(1), corner(2));
    }
    return sum.norm() / (2.0 * kPi);
}

// 2^18 rays: N^-3/4 of half of them is 1.5e-4; three of these over √2. Small regions have few rays,
// whose relative error is that of their count. A start off the vertex sees 1e-4 past the far edges.
double tolerance(double expected) {
    return std::min(3.2e-4, 4.0 * std::sqrt(expected / kRays)) + 1e-5;
}

// A pit in a rock, and the rock's tip: a cone with an oval rim, leaning to a side.
std::vector<Vec3d> oval(double length, double width, double lean, int n = 12) {
    std::vector<Vec3d> rim;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * kPi * i / n;
        rim.emplace_back(length * std::cos(angle) + lean, width * std::sin(angle) + 0.3 * lean,
                         1.0);
    }
    return rim;
}

TEST(Folds, APitOfAnyWidthSeesItsOpening) {
    size_t num_fans = 0;
    for (const double width : {1.0, 0.1, 0.01, 1e-3}) {
        for (const double length : {1.0, 0.2}) {
            for (const double lean : {0.0, 0.7}) {
                const Mesh pit = cone(oval(length, width, lean));
                const double expected = share_of_region(pit);
                EXPECT_NEAR(share(pit, 0), expected, tolerance(expected))
                    << width << ' ' << length << ' ' << lean;
                std::vector<Vec3f> normals(pit.positions.size(), Vec3f::Zero());
                normals[0] = normal_of(pit, 0);
                num_fans += RayStarts(pit.topology, pit.positions, normals).num_fans();
            }
        }
    }
    EXPECT_GT(num_fans, 3u);  // the slits
}

TEST(Folds, TheTipOfAConeSeesItsWholeHemisphere) {
    for (const double width : {1.0, 0.1, 0.01, 1e-3}) {
        for (const double lean : {0.0, 0.7}) {
            // Convex, round or flat, upright or leaning: no face is above the plane of the normal.
            EXPECT_NEAR(share(turned(cone(oval(width, width, lean))), 0), 1.0, 1e-6) << width;
            EXPECT_NEAR(share(turned(cone(oval(0.3, width, lean))), 0), 1.0, 1e-6) << width;
        }
    }
}

// A crease along the y axis between two sheets of n cells each, of which the right one rises by the
// angle.
Mesh crease(double angle, uint32_t n) {
    Mesh mesh;
    const uint32_t width = 2 * n + 1;
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i < width; ++i) {
            const double x = static_cast<double>(i) - n, y = static_cast<double>(j);
            const double turn = x > 0 ? angle : 0.0;
            mesh.positions.push_back(
                Vec3d(std::cos(turn) * x, y, std::sin(turn) * x).cast<float>());
            if (i + 1 == width || j == n) continue;
            const uint32_t v = j * width + i;
            mesh.topology.triangles.push_back({v, v + 1, v + width + 1});
            mesh.topology.triangles.push_back({v, v + width + 1, v + width});
        }
    }
    mesh.topology.num_vertices = static_cast<uint32_t>(mesh.positions.size());
    return mesh;
}

TEST(Folds, BothSidesOfACreaseSeeWhatIsBetweenTheSheets) {
    constexpr uint32_t n = 4;
    constexpr size_t kMiddle = (2 * n + 1) * (n / 2) + n;
    for (const double opening_deg : {150.0, 90.0, 30.0, 5.0, 1.0, 0.1}) {
        const double opening = opening_deg * kPi / 180.0;
        const Mesh valley = crease(kPi - opening, n);
        // Between two half-planes: ½ (sum of their normals) · n.
        const Vec3d left(0, 0, 1), right(-std::sin(opening), 0, -std::cos(opening));
        const double expected = 0.5 * (left + right).dot(normal_of(valley, kMiddle).cast<double>());
        EXPECT_NEAR(expected, std::sin(0.5 * opening), 1e-6);
        EXPECT_NEAR(share(valley, kMiddle), expected, tolerance(expected)) << opening_deg;
        // The ridge on the other side sees all of its hemisphere.
        EXPECT_NEAR(share(turned(valley), kMiddle), 1.0, 1e-6) << opening_deg;
    }
}

// The same with vertices of its own for each sheet, and the sheets' normals: a hard edge. A start on
// the left normal would lie in the right sheet, or behind it.
TEST(Folds, HardEdgesSeeWhatIsBetweenTheSheets) {
    constexpr uint32_t n = 4;
    constexpr uint32_t kWidth = 2 * n + 1;
    constexpr size_t kMiddle = kWidth * (n / 2) + n;
    for (const double opening_deg : {120.0, 90.0, 45.0, 10.0, 0.5}) {
        const double opening = opening_deg * kPi / 180.0;
        Mesh valley = crease(kPi - opening, n);
        const uint32_t first = valley.topology.num_vertices;
        for (uint32_t j = 0; j <= n; ++j)
            valley.positions.push_back(valley.positions[j * kWidth + n]);
        valley.topology.num_vertices += n + 1;
        for (Triangle& t : valley.topology.triangles) {
            const bool right =
                std::any_of(t.begin(), t.end(), [](uint32_t v) { return v % kWidth > n; });
            for (uint32_t& v : t) {
                if (right && v % kWidth == n) v = first + v / kWidth;
            }
        }
        const Vec3d left(0, 0, 1), right(-std::sin(opening), 0, -std::cos(opening));
        const double expected = 0.5 * (left + right).dot(left);
        EXPECT_NEAR(share(valley, left.cast<float>(), kMiddle), expected, tolerance(expected))
            << opening_deg;
        EXPECT_NEAR(share(valley, right.cast<float>(), first + n / 2), expected,
                    tolerance(expected))
            << opening_deg;
    }
}

// A fin that grows out of the ground from a point: the ground left of the origin, and right of it
// two walls that rise to a blade. At its foot the walls are edge-on to the normal.
TEST(Folds, TheFootOfAFinIsNotBlack) {
    for (const double thick : {0.3, 0.03, 3e-3, 3e-4}) {
        for (const double height : {0.5, 3.0, 30.0}) {
            const Mesh foot = cone({{1, thick, 0},  // where the wall meets the ground
                                    {0, 1, 0},
                                    {-1, 0.2, 0},
                                    {-0.3, -1, 0},
                                    {1, -thick, 0},
                                    {1, 0, height}});  // the blade
            const Vec3d normal = vertex_normals(foot.topology, foot.positions)[0].cast<double>();
            // What the fin leaves: the directions above the faces in the normal's hemisphere, summed
            // on a grid of directions of equal cosine-weighted solid angle.
            double open = 0.0, all = 0.0;
            constexpr int kGrid = 600;
            const Vec3d u = normal.unitOrthogonal(), w = normal.cross(u);
            for (int i = 0; i < kGrid; ++i) {
                for (int j = 0; j < kGrid; ++j) {
                    const double r = std::sqrt((i + 0.5) / kGrid), a = 2 * kPi * (j + 0.5) / kGrid;
                    const Vec3d d =
                        r * std::cos(a) * u + r * std::sin(a) * w + std::sqrt(1.0 - r * r) * normal;
                    // Above the ground, and not between the walls below the blade.
                    const bool in_fin = d.x() > 0 && d.z() < height * d.x() &&
                                        std::abs(d.y()) < thick * (d.x() - d.z() / height);
                    all += 1.0;
                    open += d.z() > 0 && !in_fin ? 1.0 : 0.0;
                }
            }
            const double expected = open / all;
            EXPECT_GT(expected, 0.3);
            EXPECT_NEAR(share(foot, 0), expected, 2e-3) << thick << ' ' << height;
        }
    }
}

// Cards with normals that point up along them, as foliage has: the start is in front of the card.
// Below the horizon of the card's front the card itself is in the way.
TEST(Folds, CardsWithNormalsInTheirPlaneSeeWhatIsInFrontOfThem) {
    for (const float turn : {0.0f, 0.4f, 1.1f, 2.0f}) {
        for (const float scale : {1e-6f, 1.0f, 1e6f}) {
            Mesh card;
            const Vec3f side = Vec3f(std::cos(turn), 0, std::sin(turn));
            for (int j = 0; j <= 4; ++j) {
                for (int i = 0; i <= 4; ++i) {
                    card.positions.push_back(scale *
                                             (0.1f * static_cast<float>(i) * side +
                                              Vec3f(0.37f, 0.1f * static_cast<float>(j), 0.51f)));
                    if (i == 4 || j == 4) continue;
                    const auto v = static_cast<uint32_t>(5 * j + i);
                    card.topology.triangles.push_back({v, v + 1, v + 6});
                    card.topology.triangles.push_back({v, v + 6, v + 5});
                }
            }
            card.topology.num_vertices = 25;
            const Vec3f up = Vec3f::UnitY();
            for (const bool back : {false, true}) {
                const Mesh mesh = back ? turned(card) : card;
                // Half of the upper hemisphere is in front. The rest passes next to and above the card
                // from its rim: all of it at the top, none in the middle of its foot.
                EXPECT_NEAR(share(mesh, up, 2), 0.5, tolerance(0.5)) << turn << ' ' << scale;
                EXPECT_NEAR(share(mesh, up, 7), 0.5, tolerance(0.5)) << turn << ' ' << scale;
                EXPECT_NEAR(share(mesh, up, 22), 1.0, tolerance(0.5)) << turn << ' ' << scale;
                for (size_t v = 0; v < 25; ++v) {
                    EXPECT_GT(share(mesh, up, v, 1024), 0.48) << v << ' ' << turn << ' ' << scale;
                }
            }
        }
    }
}

TEST(Folds, ConvexMeshesNeverShadowThemselvesHoweverThinTheyAre) {
    // Spheres squashed to needles and discs, so that normals at their rims are steep.
    for (const Vec3f& factors : {Vec3f(1, 1e-3f, 1e-3f), Vec3f(1, 1, 1e-4f), Vec3f(1, 0.05f, 1e-3f),
                                 Vec3f(3, 1e-5f, 1), Vec3f(1e4f, 1, 1)}) {
        for (const uint32_t num_vertices : {50u, 162u, 642u}) {
            const auto sphere = poses::make_sphere_sequence(num_vertices);
            std::vector<Vec3f> positions = sphere->positions(0, 1);
            for (Vec3f& x : positions) x = x.cwiseProduct(factors);
            const PoseSet set(sphere->topology(), {positions});
            const auto statistics =
                TransferBaker({1, 1024, 5}).bake(set.topology(), set.load_pose(0), 0).statistics;
            EXPECT_EQ(statistics.occluded, 0u) << factors.transpose() << ' ' << num_vertices;
        }
    }
}

}  // namespace
}  // namespace paim
