// Vertex normals: closed forms, cuts of polygons, scale independence, and meshes without area.
#include "paim/mesh/normals.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "paim/base/seed.h"

namespace paim {
namespace {

TEST(VertexNormals, WeighUnitFaceNormalsByTheirAngles) {
    // Two faces meeting at a right angle, of very different areas.
    const Topology topology{4, {{0, 1, 2}, {0, 3, 1}}};
    const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {0, 10, 0}, {0, 0, 1}};
    const auto normals = vertex_normals(topology, positions);
    // Face 0 faces +z; face 1 (0,3,1) faces z × x = +y. Both have a right angle at vertex 0.
    EXPECT_LT((normals[0] - Vec3f(0, 1, 1).normalized()).norm(), 1e-6f);
    const Vec3d at_1(0, kPi / 4, std::atan(10.0));
    EXPECT_LT((normals[1] - at_1.normalized().cast<float>()).norm(), 1e-6f);
    EXPECT_LT((normals[2] - Vec3f(0, 0, 1)).norm(), 1e-6f);
    EXPECT_LT((normals[3] - Vec3f(0, 1, 0)).norm(), 1e-6f);
}

// A unit cube about the origin, each face cut along one or the other diagonal.
TEST(VertexNormals, OfACubeLieOnItsDiagonalsHoweverItsFacesAreCut) {
    std::vector<Vec3f> corners;
    for (uint32_t v = 0; v < 8; ++v) {
        corners.emplace_back(v & 1 ? 1.0f : -1.0f, v & 2 ? 1.0f : -1.0f, v & 4 ? 1.0f : -1.0f);
    }
    const std::array<uint32_t, 4> faces[6] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                              {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    for (uint32_t cut = 0; cut < 64; ++cut) {
        Topology topology{8, {}};
        for (uint32_t f = 0; f < 6; ++f) {
            const auto [a, b, c, d] = faces[f];
            if (cut >> f & 1) {
                topology.triangles.insert(topology.triangles.end(), {{a, b, c}, {a, c, d}});
            } else {
                topology.triangles.insert(topology.triangles.end(), {{a, b, d}, {b, c, d}});
            }
        }
        const auto normals = vertex_normals(topology, corners);
        for (size_t v = 0; v < 8; ++v) {
            // Half an ulp of each coordinate.
            EXPECT_LT((normals[v] - corners[v].normalized()).cwiseAbs().maxCoeff(), 1e-7f) << cut;
        }
    }
}

// A prism of n sides between two regular polygons.
struct Prism {
    uint32_t n;
    std::vector<Vec3f> positions;  // lower, upper, and the centres of both
    Topology sides;

    explicit Prism(uint32_t num_sides) : n(num_sides) {
        for (const float z : {0.0f, 2.0f}) {
            for (uint32_t i = 0; i < n; ++i) {
                const double angle = 2.0 * kPi * i / n;
                positions.emplace_back(static_cast<float>(std::cos(angle)),
                                       static_cast<float>(std::sin(angle)), z);
            }
        }
        positions.emplace_back(0.0f, 0.0f, 0.0f);
        positions.emplace_back(0.0f, 0.0f, 2.0f);
        sides.num_vertices = 2 * n + 2;
        for (uint32_t i = 0; i < n; ++i) {
            const uint32_t j = (i + 1) % n;
            sides.triangles.push_back({i, j, n + j});
            sides.triangles.push_back({i, n + j, n + i});
        }
    }

    // Caps of the triangles (a, b, c) of the polygon's corners, the lower one turned.
    std::vector<Vec3f> normals(const std::vector<Triangle>& cut) const {
        Topology whole = sides;
        for (const auto& [a, b, c] : cut) {
            const auto upper = [&](uint32_t i) { return i < n ? n + i : 2 * n + 1; };
            const auto lower = [&](uint32_t i) { return i < n ? i : 2 * n; };
            whole.triangles.push_back({upper(a), upper(b), upper(c)});
            whole.triangles.push_back({lower(a), lower(c), lower(b)});
        }
        auto all = vertex_normals(whole, positions);
        all.resize(2 * n);
        return all;
    }
};

TEST(VertexNormals, DoNotDependOnHowPolygonsAreCut) {
    for (const uint32_t n : {3u, 4u, 5u, 7u, 48u}) {
        const Prism prism(n);
        std::vector<Triangle> centre;  // about a point in the middle
        for (uint32_t i = 0; i < n; ++i) centre.push_back({n, i, (i + 1) % n});
        const auto expected = prism.normals(centre);
        // The closed form: the cap's angle π − 2π/n against two right angles of the sides.
        const double cap = kPi - 2.0 * kPi / n;
        const double side = kPi * std::cos(kPi / n);  // both, along the radius
        for (uint32_t i = 0; i < 2 * n; ++i) {
            const Vec3d radius(prism.positions[i].x(), prism.positions[i].y(), 0.0);
            const Vec3d normal = side * radius.normalized() + Vec3d(0, 0, i < n ? -cap : cap);
            EXPECT_LT((expected[i].cast<double>() - normal.normalized()).norm(), 3e-7) << n;
        }
        for (uint32_t first = 0; first < n; ++first) {
            std::vector<Triangle> fan, zigzag;
            for (uint32_t i = 1; i + 1 < n; ++i) {
                fan.push_back({first, (first + i) % n, (first + i + 1) % n});
            }
            uint32_t low = first + 1, high = first + n;  // the rest of the polygon
            for (bool at_low = true; low + 1 < high; at_low = !at_low) {
                const uint32_t third = at_low ? low + 1 : high - 1;
                zigzag.push_back({low % n, third % n, high % n});
                (at_low ? low : high) = third;
            }
            for (const auto& cut : {fan, zigzag}) {
                const auto normals = prism.normals(cut);
                // Sums of n angles, in double, are the same up to their rounding, so that floats
                // differ by one ulp at most. Corners are off their plane's circle by 2^-25.
                for (uint32_t i = 0; i < 2 * n; ++i) {
                    EXPECT_LT((normals[i] - expected[i]).norm(), 3e-7f) << n << ' ' << first;
                }
            }
        }
    }
}

TEST(VertexNormals, AreExactBesideNeedlesAndFacesWithoutAngle) {
    // A corner of three axes' planes. Needles at it have almost no angle and almost no weight;
    // triangles on a line have none. Their own normals lie in other planes.
    const std::vector<Vec3f> positions{{0, 0, 0},  {1, 0, 0},       {0, 1, 0},    {0, 0, 1},
                                       {-1, 1, 0}, {-1, 1, 1e-12f}, {-2, -2, -2}, {-1, -1, -1}};
    const Topology topology{8, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 4, 5}, {0, 6, 7}}};
    const auto normals = vertex_normals(topology, positions);
    // The needle's angle is 1e-12 / √2 of one right angle.
    EXPECT_LT((normals[0] - Vec3f(1, 1, 1).normalized()).cwiseAbs().maxCoeff(), 1e-7f);
    // At its thin end the needle is the only face.
    EXPECT_LT((normals[4] - Vec3f(1, 1, 0).normalized()).norm(), 1e-6f);
    EXPECT_LT((normals[5] - Vec3f(1, 1, 0).normalized()).norm(), 1e-6f);
    EXPECT_TRUE(normals[6].isZero(0.0f));
}

TEST(VertexNormals, OfNeedlesAloneHaveTheirDirection) {
    for (const float width : {1e-3f, 1e-8f, 1e-14f}) {
        const std::vector<Vec3f> positions{{0, 0, 0}, {1, 0, 0}, {1, width, 0}};
        for (const Vec3f& n : vertex_normals({3, {{0, 1, 2}}}, positions)) {
            EXPECT_LT((n - Vec3f(0, 0, 1)).norm(), 1e-6f) << width;
        }
    }
}

TEST(CornerAngles, AreExactFromNeedlesToStraightCorners) {
    for (const double angle : {1e-14, 1e-8, 1e-3, 0.5, kPi / 2, 3.0, kPi - 1e-3}) {
        const Vec3f b(1, 0, 0);
        const Vec3f c = Vec3d(std::cos(angle), std::sin(angle), 0.0).cast<float>();
        const double given = std::atan2(static_cast<double>(c.y()), static_cast<double>(c.x()));
        const auto angles = corner_angles({0, 0, 0}, b, c);
        EXPECT_NEAR(angles[0], given, 4e-16 * std::max(1.0, given)) << angle;
        EXPECT_NEAR(angles[0] + angles[1] + angles[2], kPi, 2e-15) << angle;
    }
}

TEST(VertexNormals, DoNotDependOnScale) {
    RandomStream random(3);
    const auto uniform = [&] { return static_cast<float>(random.uniform() - 0.5); };
    Topology topology{12, {}};
    std::vector<Vec3f> positions{{0, 0, 0}};
    for (uint32_t i = 1; i < 12; ++i) {
        positions.emplace_back(uniform(), uniform(), uniform());
        topology.triangles.push_back({0, i, i % 11 + 1});
    }
    const auto expected = vertex_normals(topology, positions);
    for (const float scale : {1e-30f, 1e-6f, 1e6f, 1e30f}) {
        std::vector<Vec3f> scaled = positions;
        for (Vec3f& x : scaled) x *= scale;
        const auto normals = vertex_normals(topology, scaled);
        for (size_t v = 0; v < normals.size(); ++v) {
            // Scaling rounds the positions by 2^-24.
            EXPECT_LT((normals[v] - expected[v]).norm(), 2e-6f) << scale;
        }
    }
    for (const float scale : {0x1p-90f, 0x1p100f}) {
        std::vector<Vec3f> scaled = positions;
        for (Vec3f& x : scaled) x *= scale;
        EXPECT_EQ(vertex_normals(topology, scaled), expected);
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

TEST(VertexNormals, AreSharedByTheVerticesOfASeam) {
    // Two faces at a right angle along the z axis, with vertices of their own there (0, 1 and 2, 3).
    const std::vector<Vec3f> positions{{0, 0, 0}, {0, 0, 1}, {0, 0, 0},
                                       {0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    const Topology topology{6, {{0, 4, 1}, {2, 3, 5}}};
    const std::vector<uint32_t> seams{0, 1, 0, 1, 4, 5};
    const auto apart = vertex_normals(topology, positions);
    EXPECT_LT((apart[0] - Vec3f(0, -1, 0)).norm(), 1e-6f);
    EXPECT_LT((apart[2] - Vec3f(-1, 0, 0)).norm(), 1e-6f);
    const auto shared = vertex_normals(topology, positions, seams);
    for (size_t v = 0; v < 4; ++v) {
        EXPECT_LT((shared[v] - Vec3f(-1, -1, 0).normalized()).norm(), 1e-6f) << v;
    }
    EXPECT_EQ(shared[4], apart[4]);
    EXPECT_EQ(shared[5], apart[5]);
}

}  // namespace
}  // namespace paim
