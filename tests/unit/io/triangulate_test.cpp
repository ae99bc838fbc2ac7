// Triangulation: closed forms, area and winding kept, shapes without area.
#include "compressor/io/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "paim/base/vector.h"

namespace paim {
namespace {

using Triangles = std::vector<Triangle>;

// One polygon with the corners 0, 1, 2, ...
Polygons polygon_of(const std::vector<Vec3f>& points) {
    Polygons polygons{{static_cast<uint32_t>(points.size())}, {}};
    polygons.corners.resize(points.size());
    std::iota(polygons.corners.begin(), polygons.corners.end(), 0u);
    return polygons;
}

Triangulation cut(const std::vector<Vec3f>& points) {
    return triangulate(polygon_of(points), points);
}

// Area along +z of the triangles, and of the least one.
struct Areas {
    double sum = 0.0;
    double least = 1e300;
};
Areas areas(const Triangles& triangles, const std::vector<Vec3f>& points) {
    Areas areas;
    for (const Triangle& t : triangles) {
        const Vec3d a = points[t[0]].cast<double>();
        const Vec3d b = points[t[1]].cast<double>(), c = points[t[2]].cast<double>();
        const double area = 0.5 * (b - a).cross(c - a).z();
        areas.sum += area;
        areas.least = std::min(areas.least, area);
    }
    return areas;
}

// Edges that one triangle has and no other has the other way round.
size_t num_open_edges(const Triangles& triangles) {
    std::vector<std::pair<uint32_t, uint32_t>> edges;
    for (const Triangle& t : triangles) {
        for (int i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
    }
    size_t count = 0;
    for (const auto& [a, b] : edges) {
        if (std::find(edges.begin(), edges.end(), std::pair(b, a)) == edges.end()) ++count;
    }
    return count;
}

TEST(Triangulate, KeepsTriangles) {
    const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    EXPECT_EQ(cut(points).triangles, (Triangles{{0, 1, 2}}));
}

TEST(Triangulate, CutsQuadsAlongTheShorterDiagonal) {
    const std::vector<Vec3f> long_02{{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {1, 1, 0}};
    EXPECT_EQ(cut(long_02).triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
    const std::vector<Vec3f> long_13{{1, 0, 0}, {4, 0, 0}, {3, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(cut(long_13).triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Triangulate, TakesEqualDiagonalsAsATie) {
    // Longer at the first corner by less than 1e-5 of the length, then by more.
    const std::vector<Vec3f> tie{{0, 0, 0}, {1, 0, 0}, {1.00001f, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(cut(tie).triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
    const std::vector<Vec3f> longer{{0, 0, 0}, {1, 0, 0}, {1.0001f, 1, 0}, {0, 1, 0}};
    EXPECT_EQ(cut(longer).triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(Triangulate, CutsConcaveQuadsInside) {
    // A dart: the shorter diagonal 1-3, of length 0.2, lies outside.
    const std::vector<Vec3f> dart{{0, 0, 0}, {1, -0.1f, 0}, {0.9f, 0, 0}, {1, 0.1f, 0}};
    // Its sharp tip is corner 0 and the notch corner 2.
    for (size_t turn = 0; turn < 4; ++turn) {
        std::vector<Vec3f> points;
        for (size_t i = 0; i < 4; ++i) points.push_back(dart[(i + turn) % 4]);
        const Triangulation result = cut(points);
        EXPECT_EQ(result.num_degenerate, 0u);
        EXPECT_GT(areas(result.triangles, points).least, 0.0) << turn;
    }
}

TEST(Triangulate, CutsPolygonsIntoTheirArea) {
    // A comb with many notches, in order, turned and mirrored; area by the shoelace formula.
    std::vector<Vec3f> comb{{0, 0, 0}, {20, 0, 0}};
    for (int i = 10; i > 0; --i) {
        comb.push_back({2.0f * i, 3, 0});
        comb.push_back({2.0f * i - 1.0f, 1, 0});
    }
    double expected = 0.0;
    for (size_t i = 0; i < comb.size(); ++i) {
        const Vec3f &a = comb[i], &b = comb[(i + 1) % comb.size()];
        expected += 0.5 * (double{a.x()} * b.y() - double{a.y()} * b.x());
    }
    for (size_t turn = 0; turn < comb.size(); ++turn) {
        const Triangulation result = cut(comb);
        EXPECT_EQ(result.triangles.size(), comb.size() - 2);
        EXPECT_EQ(result.num_degenerate, 0u);
        EXPECT_EQ(num_open_edges(result.triangles), comb.size());
        const Areas got = areas(result.triangles, comb);
        EXPECT_NEAR(got.sum, expected, 1e-12 * expected);  // small integers, exact in double
        EXPECT_GT(got.least, 0.0);
        std::rotate(comb.begin(), comb.begin() + 1, comb.end());
    }
}

TEST(Triangulate, DoesNotDependOnScalePlaceOrPlane) {
    const std::vector<Vec3f> arrow{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}};
    const Triangles expected = cut(arrow).triangles;
    for (const float scale : {1e-30f, 1.0f, 1e30f}) {
        std::vector<Vec3f> points;
        // Into the plane x = 0 with the same sense of rotation.
        for (const Vec3f& p : arrow) points.push_back(scale * Vec3f(0, p.x(), p.y()));
        EXPECT_EQ(cut(points).triangles, expected) << scale;
    }
    std::vector<Vec3f> far;
    for (const Vec3f& p : arrow) far.push_back(p + Vec3f(4096, -4096, 8192));
    EXPECT_EQ(cut(far).triangles, expected);
}

TEST(Triangulate, CutsPolygonsWithStraightCornersAndHoles) {
    // Corners in the middle of edges: no triangle may lack area.
    const std::vector<Vec3f> straight{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0},
                                      {0, 2, 0}, {0, 1, 0}, {0, 0, 0}};
    const Triangulation result = cut(straight);
    EXPECT_EQ(result.num_degenerate, 0u);
    EXPECT_DOUBLE_EQ(areas(result.triangles, straight).sum, 4.0);
    EXPECT_GT(areas(result.triangles, straight).least, 0.0);

    // A square with a square hole, joined by a bridge whose ends the polygon names twice.
    const std::vector<Vec3f> points{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                                    {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
    const Polygons ring{{10}, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}};
    const Triangulation cut_ring = triangulate(ring, points);
    EXPECT_EQ(cut_ring.num_repeating, 1u);
    EXPECT_EQ(cut_ring.num_degenerate, 0u);
    EXPECT_DOUBLE_EQ(areas(cut_ring.triangles, points).sum, 8.0);
    EXPECT_GT(areas(cut_ring.triangles, points).least, 0.0);
}

TEST(Triangulate, CutsPolygonsThatTouchThemselves) {
    // Two triangles that share the corner 0, as one polygon: its two visits do not block each
    // other.
    const std::vector<Vec3f> points{
        {0, 0, 0}, {1, -0.5f, 0}, {1, 0.5f, 0}, {-1, 0.5f, 0}, {-1, -0.5f, 0}};
    const Triangulation result = triangulate({{6}, {0, 1, 2, 0, 3, 4}}, points);
    EXPECT_EQ(result.num_degenerate, 0u);
    EXPECT_DOUBLE_EQ(areas(result.triangles, points).sum, 1.0);
}

TEST(Triangulate, MergesCornersThatRepeatTheirNeighbour) {
    const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    for (const Polygons& quad : {Polygons{{4}, {0, 1, 1, 2}}, Polygons{{5}, {0, 0, 1, 2, 0}}}) {
        const Triangulation result = triangulate(quad, points);
        EXPECT_EQ(result.triangles, (Triangles{{0, 1, 2}}));
        EXPECT_EQ(result.num_repeating, 1u);
        EXPECT_EQ(result.num_degenerate, 0u);
    }
}

TEST(Triangulate, CountsShapesWithoutAreaAndFansThem) {
    const std::vector<Vec3f> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    Triangulation result = cut(line);
    EXPECT_EQ(result.num_degenerate, 1u);
    EXPECT_EQ(result.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
    const std::vector<Vec3f> point(4, Vec3f(1, 2, 3));
    result = cut(point);
    EXPECT_EQ(result.num_degenerate, 1u);
    EXPECT_EQ(result.triangles.size(), 2u);
    const std::vector<Vec3f> bow{{0, 0, 0}, {1, 0, 0}, {0, 3, 0}, {3, 3, 0}};
    result = cut(bow);
    EXPECT_EQ(result.num_degenerate, 1u);
    EXPECT_EQ(result.triangles.size(), 2u);
}

TEST(Triangulate, DropsWhatNamesAVertexTwice) {
    const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Polygons polygons{{3, 4, 4, 5, 4, 3},
                            {0, 1, 1, 0, 1, 1, 2, 0, 1, 0, 2, 0, 1, 2, 3, 0, 1, 1, 1, 1, 0, 1, 2}};
    const Triangulation result = triangulate(polygons, points);
    EXPECT_EQ(result.num_repeating, 5u);
    // Of 0 1 0 2, either cut leaves only triangles with a vertex twice or one that is 0 1 2 wound
    // the other way; it must not leave one with a vertex twice.
    for (const Triangle& t : result.triangles) {
        EXPECT_TRUE(t[0] != t[1] && t[1] != t[2] && t[2] != t[0]);
    }
    EXPECT_EQ(result.triangles.front(), (Triangle{0, 1, 2}));
    EXPECT_EQ(result.triangles.back(), (Triangle{0, 1, 2}));
}

TEST(Triangulate, TellsWhichPolygonATriangleIsOf) {
    const std::vector<Vec3f> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}};
    const Polygons polygons{{3, 3, 4, 5, 3},
                            {0, 1, 2, 0, 0, 1, 0, 1, 2, 3, 0, 1, 2, 4, 3, 0, 2, 3}};
    EXPECT_EQ(triangulate(polygons, points).polygons, (std::vector<uint32_t>{0, 2, 2, 3, 3, 3, 4}));
}

}  // namespace
}  // namespace paim
