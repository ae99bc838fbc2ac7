// Cuts of polygons that depend on no pose in which the polygon is degenerate.
#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <random>
#include <thread>

#include "compressor/io/triangulate.h"
#include "tests/unit/io/obj_test_files.h"

namespace paim {
namespace {

using Shape = std::vector<Vec3d>;
using Triangles = std::vector<Triangle>;

Polygons polygon_of(size_t num_corners) {
    Polygons polygons{{static_cast<uint32_t>(num_corners)}, {}};
    polygons.corners.resize(num_corners);
    std::iota(polygons.corners.begin(), polygons.corners.end(), 0u);
    return polygons;
}

std::vector<Vec3f> to_float(const Shape& shape) {
    std::vector<Vec3f> points;
    for (const Vec3d& point : shape) points.push_back(point.cast<float>());
    return points;
}

Triangulation cut(const Polygons& polygons, const std::vector<Shape>& poses) {
    const std::vector<Vec3f> first = to_float(poses[0]);
    Triangulator triangulator(polygons, first);
    for (uint32_t p = 1; p < poses.size(); ++p) triangulator.review(p, poses[p], Vec3d::Zero());
    return triangulator.finish();
}

// The sums of the areas of triangles that face along +z, and of those that face against it.
std::pair<double, double> areas(const Triangles& triangles, const Shape& shape) {
    std::pair<double, double> sums;
    for (const Triangle& t : triangles) {
        const Vec3d a = shape[t[0]], b = shape[t[1]], c = shape[t[2]];
        const double area = 0.5 * (b - a).cross(c - a).z();
        (area > 0.0 ? sums.first : sums.second) += area;
    }
    return sums;
}

double area_of(const Polygons& polygons, const Shape& shape) {
    double sum = 0.0;
    for (size_t i = 0; i < polygons.corners.size(); ++i) {
        const Vec3d& a = shape[polygons.corners[i]];
        const Vec3d& b = shape[polygons.corners[(i + 1) % polygons.corners.size()]];
        sum += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
    return sum;
}

// Whether the cut covers the polygon, and nothing else, in this pose.
void expect_covers(const Triangles& triangles, const Polygons& polygons, const Shape& shape) {
    const double area = area_of(polygons, shape);
    const auto [front, back] = areas(triangles, shape);
    EXPECT_NEAR(front, area, 1e-6 * area);
    EXPECT_NEAR(back, 0.0, 1e-6 * area);
}

Shape scaled(const Shape& shape, double x, double y, double z = 1.0) {
    Shape result;
    for (const Vec3d& point : shape) result.push_back(point.cwiseProduct(Vec3d(x, y, z)));
    return result;
}

const Shape kDart{{0, 0, 0}, {1, -0.1, 0}, {0.9, 0, 0}, {1, 0.1, 0}};
const Shape kAngle{{1, 0, 0}, {1, 0.3, 0}, {0.3, 0.3, 0}, {0.3, 1, 0}, {0, 1, 0}, {0, 0, 0}};

// A polygon around the origin whose corners are at random distances. Every third corner lies in
// the middle of its neighbours if `straight`.
Shape star(size_t num_corners, bool straight, std::mt19937& random) {
    Shape shape;
    std::uniform_real_distribution<double> distance(0.2, 1.0);
    for (size_t i = 0; i < num_corners; ++i) {
        const double angle = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(num_corners);
        shape.push_back(distance(random) * Vec3d(std::cos(angle), std::sin(angle), 0.0));
    }
    for (size_t i = 1; straight && i + 1 < num_corners; i += 3) {
        shape[i] = 0.5 * (shape[i - 1] + shape[i + 1]);
    }
    return shape;
}

// Poses in which the polygon has no area, or next to none, in front of the one in which it has.
std::vector<std::vector<Shape>> appearances(const Shape& shape) {
    Shape crumpled = scaled(shape, 1e-7, 1e-7);
    for (size_t i = 0; i < shape.size(); i += 2) crumpled[i] *= -0.5;
    return {
        {scaled(shape, 0, 0), shape},                // grows from a point
        {scaled(shape, 0, 1), shape},                // and from a line
        {scaled(shape, 1e-3, 1), shape},             // from a sliver
        {scaled(shape, -1e-6, 1e-3), shape},         // that is mirrored
        {crumpled, scaled(shape, 0.1, 0.1), shape},  // from a tangle
        {scaled(shape, 0, 0), shape, scaled(shape, 0, 1), scaled(shape, 3, 3)},
    };
}

TEST(TriangulatePoses, CutsWhatAppearsByThePoseInWhichItHasArea) {
    std::mt19937 random(5);
    std::vector<Shape> shapes{kDart, kAngle};
    for (size_t num = 5; num <= 100; ++num) shapes.push_back(star(num, num % 2 == 0, random));
    for (Shape shape : shapes) {
        const Polygons polygons = polygon_of(shape.size());
        for (size_t turn = 0; turn < std::min<size_t>(shape.size(), 6); ++turn) {
            for (const std::vector<Shape>& poses : appearances(shape)) {
                const Triangulation result = cut(polygons, poses);
                EXPECT_EQ(result.triangles.size(), shape.size() - 2);
                EXPECT_EQ(result.num_degenerate, 0u);
                expect_covers(result.triangles, polygons, shape);
            }
            std::rotate(shape.begin(), shape.begin() + 1, shape.end());
        }
    }
}

TEST(TriangulatePoses, CutsHolesWithBridges) {
    const Shape points{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0},
                       {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}};
    const Polygons ring{{10}, {0, 1, 2, 3, 0, 4, 5, 6, 7, 4}};
    for (const std::vector<Shape>& poses : appearances(points)) {
        const Triangulation result = cut(ring, poses);
        EXPECT_EQ(result.num_degenerate, 0u);
        EXPECT_EQ(result.num_repeating, 1u);
        expect_covers(result.triangles, ring, points);
    }
}

TEST(TriangulatePoses, KeepsTheFirstPosesCutWhereItIsRight) {
    const Shape square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const Shape leaning{{0, 0, 0}, {3, 0, 0}, {4, 1, 0}, {1, 1, 0}};  // cut along 1-3 if alone
    EXPECT_EQ(cut(polygon_of(4), {square, leaning, scaled(leaning, 0, 1)}).triangles,
              (Triangles{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_EQ(cut(polygon_of(4), {leaning, square}).triangles, (Triangles{{0, 1, 3}, {1, 2, 3}}));
}

TEST(TriangulatePoses, RespectsNotchesThatAppearLater) {
    // A square with corners in the middle of its sides, of which one moves in.
    const Shape filled{{1, 0, 0}, {1, 1, 0}, {0.5, 1, 0}, {0, 1, 0}, {0, 0.5, 0}, {0, 0, 0}};
    for (size_t turn = 0; turn < 6; ++turn) {
        Shape before = filled, after = kAngle;
        // The angle's notch is its corner 2: that of the square lies outside the angle.
        before[2] = {0.9, 0.9, 0};
        before[1] = {1, 0.5, 0};
        before[3] = {0.5, 1, 0};
        before[4] = {0, 1, 0};
        std::rotate(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(turn),
                    before.end());
        std::rotate(after.begin(), after.begin() + static_cast<std::ptrdiff_t>(turn), after.end());
        const Polygons polygons = polygon_of(6);
        for (const std::vector<Shape>& poses :
             {std::vector{before, after}, std::vector{after, before}}) {
            const Triangulation result = cut(polygons, poses);
            expect_covers(result.triangles, polygons, before);
            expect_covers(result.triangles, polygons, after);
        }
    }
    // A quad that becomes a dart, whichever corner moves in.
    for (const int corner : {0, 1, 2, 3}) {
        Shape kite{{0, 0, 0}, {1, -1, 0}, {2, 0, 0}, {1, 1, 0}}, dart = kite;
        dart[static_cast<size_t>(corner)] =
            Vec3d(1, 0, 0) - 0.5 * (kite[static_cast<size_t>(corner)] - Vec3d(1, 0, 0));
        const Polygons polygons = polygon_of(4);
        const Triangulation result = cut(polygons, {kite, dart});
        expect_covers(result.triangles, polygons, kite);
        expect_covers(result.triangles, polygons, dart);
    }
}

TEST(TriangulatePoses, CutsAsAFanWhatNeverHasArea) {
    const Shape point(6, Vec3d(1, 2, 3));
    const Triangulation result = cut(polygon_of(6), {point, scaled(kAngle, 0, 1), point});
    EXPECT_EQ(result.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}));
    EXPECT_EQ(result.num_degenerate, 1u);
}

TEST(TriangulatePoses, ReplacesOneCutAmongOthers) {
    // A triangle, an angle without area at first, a corner that repeats, and a triangle.
    Shape points{{5, 5, 0}, {6, 5, 0}, {6, 6, 0}};
    points.insert(points.end(), kAngle.begin(), kAngle.end());
    Shape flat = points;
    for (size_t i = 3; i < flat.size(); ++i) flat[i] = Vec3d::Zero();
    const Polygons polygons{{3, 6, 4, 3}, {0, 1, 2, 3, 4, 5, 6, 7, 8, 0, 0, 1, 2, 2, 1, 0}};
    const Triangulation result = cut(polygons, {flat, points});
    EXPECT_EQ(result.num_degenerate, 0u);
    EXPECT_EQ(result.num_repeating, 1u);
    ASSERT_EQ(result.triangles.size(), 7u);
    EXPECT_EQ(result.triangles[0], (Triangle{0, 1, 2}));
    EXPECT_EQ(result.triangles[5], (Triangle{0, 1, 2}));
    EXPECT_EQ(result.triangles[6], (Triangle{2, 1, 0}));
    EXPECT_NEAR(areas({result.triangles.begin() + 1, result.triangles.begin() + 5}, points).first,
                0.51, 1e-12);
}

TEST(TriangulatePoses, DoesNotDependOnTheOrderOfReviews) {
    std::mt19937 random(7);
    const Shape shape = star(40, false, random);
    std::vector<Shape> poses{scaled(shape, 0, 0)};
    for (int i = 0; i < 12; ++i) poses.push_back(star(40, false, random));
    poses.push_back(poses[3]);
    const Polygons polygons = polygon_of(40);
    const Triangles expected = cut(polygons, poses).triangles;
    const std::vector<Vec3f> first = to_float(poses[0]);
    for (int turn = 0; turn < 20; ++turn) {
        Triangulator triangulator(polygons, first);
        std::vector<std::thread> threads;
        for (uint32_t t = 0; t < 3; ++t) {
            threads.emplace_back([&, t] {
                for (uint32_t p = static_cast<uint32_t>(poses.size()) - 1 - t; p > 0;
                     p = p > 3 ? p - 3 : 0) {
                    triangulator.review(p, poses[p], Vec3d::Zero());
                }
            });
        }
        for (std::thread& thread : threads) thread.join();
        EXPECT_EQ(triangulator.finish().triangles, expected);
    }
}

TEST(TriangulatePoses, CutsPolygonsOfThousandsOfCorners) {
    std::mt19937 random(9);
    for (const size_t num : {256, 1000, 3000}) {
        const Shape shape = star(num, false, random);
        const Polygons polygons = polygon_of(num);
        const Triangulation result = cut(polygons, {shape});
        EXPECT_EQ(result.num_degenerate, 0u);
        expect_covers(result.triangles, polygons, shape);
    }
    Shape circle;
    for (int i = 0; i < 100000; ++i) {
        const double angle = 2.0 * M_PI * i / 100000.0;
        circle.push_back({std::cos(angle), std::sin(angle), 0.0});
    }
    EXPECT_EQ(cut(polygon_of(circle.size()), {circle}).triangles.size(), circle.size() - 2);
}

TEST(TriangulatePoses, ReachesSequencesOfFiles) {
    // A wedge with concave ends that grows from a point, in files, and two polygons of 300 corners.
    const auto pose = [&](double scale) {
        std::string text;
        for (const double z : {0.25, -0.25}) {
            for (const Vec3d& p : kAngle) {
                text += "v " + std::to_string(scale * p.x()) + " " + std::to_string(scale * p.y()) +
                        " " + std::to_string(scale * z) + "\n";
            }
        }
        for (int i = 0; i < 300; ++i) {
            const double angle = 2.0 * M_PI * i / 300;
            text += "v " + std::to_string(std::cos(angle)) + " " + std::to_string(std::sin(angle)) +
                    " 5\n";
        }
        text += "f 2 3 4 5 6 1\nf 10 9 8 7 12 11\nf";
        for (int i = 0; i < 300; ++i) text += fmt::format(" {}", 13 + i);
        return text + "\nf 1 2 8 7\n";
    };
    const ObjTestFiles files({pose(0), pose(0.5), pose(1)});
    const ObjSequence sequence(files.files());
    const std::vector<Triangle>& triangles = sequence.topology().triangles;
    ASSERT_EQ(triangles.size(), 4u + 4u + 298u + 2u);
    Shape last;
    for (const Vec3f& p : sequence.load_pose(2).positions) last.push_back(p.cast<double>());
    const auto [front, none] = areas({triangles.begin(), triangles.begin() + 4}, last);
    const auto [no, back] = areas({triangles.begin() + 4, triangles.begin() + 8}, last);
    EXPECT_NEAR(front, 0.51, 1e-6);
    EXPECT_EQ(none, 0.0);
    EXPECT_NEAR(back, -0.51, 1e-6);
    EXPECT_EQ(no, 0.0);
    EXPECT_TRUE(sequence.warnings().empty());
}

TEST(TriangulatePoses, TrianglesThatAreCutAgainKeepTheNumberOfTheirPolygon) {
    // An L between two triangles, which is a point in the first pose.
    const Shape l{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
    const Polygons polygons{{3, 6, 3}, {0, 1, 2, 0, 1, 2, 3, 4, 5, 3, 4, 5}};
    const Triangulation result = cut(polygons, {Shape(6, Vec3d::Zero()), l});
    ASSERT_EQ(result.num_degenerate, 0u);  // it was cut again
    EXPECT_EQ(result.polygons, (std::vector<uint32_t>{0, 1, 1, 1, 1, 2}));
}

}  // namespace
}  // namespace paim
