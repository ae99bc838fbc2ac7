// Where rays start, and what the fan of a vertex hides: against cones whose outside is known.
#include "compressor/bake/ray_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "paim/base/seed.h"
#include "paim/mesh/normals.h"
#include "paim/mesh/pose_set.h"
#include "poses/octopus.h"

namespace paim {
namespace {

// A cone of triangles with its apex at vertex 0, whose outside is known. Its rim is a polygon in the
// plane z = 1: what is inside the polygon is seen from the apex, or what is not if the cone is turned.
struct Cone {
    Topology topology{1, {}};
    std::vector<Vec3f> positions{{0, 0, 0}};

    // rim  counter-clockwise, simple
    explicit Cone(const std::vector<Vec3d>& rim) {
        const auto n = static_cast<uint32_t>(rim.size());
        topology.num_vertices = n + 1;
        for (uint32_t i = 0; i < n; ++i) {
            positions.push_back(rim[i].cast<float>());
            topology.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
        }
    }

    void turn_faces() {
        for (Triangle& t : topology.triangles) std::swap(t[1], t[2]);
    }
    size_t size() const { return topology.triangles.size(); }
    Vec3d rim(size_t i) const {
        return positions[1 + i % size()].cast<double>() - positions[0].cast<double>();
    }

    bool is_inside(const Vec3d& direction) const {
        if (direction.z() <= 0.0) return false;
        bool inside = false;  // by the edges to the right of the point, as cones to the right of it
        for (size_t i = 0; i < size(); ++i) {
            const Vec3d a = rim(i), b = rim(i + 1);
            const double at_a = a.y() * direction.z() - direction.y() * a.z();
            const double at_b = b.y() * direction.z() - direction.y() * b.z();
            if ((at_a > 0.0) == (at_b > 0.0)) continue;
            const double side = a.cross(b).dot(direction);
            inside ^= (side > 0.0) == (at_b > at_a);
        }
        return inside;
    }

    // The distance of a direction from the faces (radians, about); negative if they hide it.
    double height(const Vec3d& direction) const {
        double nearest = 4.0;
        for (size_t f = 0; f < size(); ++f) {
            const Vec3d a = rim(f).normalized(), b = rim(f + 1).normalized();
            const Vec3d normal = a.cross(b).normalized();
            if (normal.cross(a).dot(direction) >= 0.0 && b.cross(normal).dot(direction) >= 0.0) {
                nearest = std::min(nearest, std::abs(normal.dot(direction)));
            }
            if (a.dot(direction) > 0) nearest = std::min(nearest, a.cross(direction).norm());
        }
        const bool is_turned = topology.triangles[0][1] != 1;
        return is_inside(direction) != is_turned ? nearest : -nearest;
    }
};

struct Directions {
    RandomStream random;
    double uniform() { return 2.0 * random.uniform() - 1.0; }
    Vec3d next() {
        for (;;) {
            const Vec3d d(uniform(), uniform(), uniform());
            if (d.squaredNorm() < 1.0 && d.squaredNorm() > 0.01) return d.normalized();
        }
    }
};

// A rim with 2n points: n in each of two chains from left to right, one above the other. Mostly no
// point of such a polygon sees all of it. `width` is its height against its length.
Cone random_cone(Directions& directions, int n, double width) {
    std::vector<Vec3d> rim;
    const double slope = directions.uniform();
    for (int i = 0; i < 2 * n; ++i) {
        const bool lower = i < n;
        const double x = (lower ? i : 2 * n - 1 - i) - 0.5 * (n - 1);
        const double y = 0.3 + 0.7 * std::abs(directions.uniform());
        rim.emplace_back(x, (lower ? -width * y : width * y) + slope * x, 1.0);
    }
    const Eigen::AngleAxisd turn(3.0 * directions.uniform(), Vec3d::UnitZ());
    for (Vec3d& point : rim) point = turn * point;
    return Cone(rim);
}

Vec3f normal_at_apex(const Cone& cone) {
    return vertex_normals(cone.topology, cone.positions)[0];
}

VertexFan fan_of(const Cone& cone, const Vec3f& normal) {
    std::vector<uint32_t> all;
    for (uint32_t f = 0; f < cone.topology.triangles.size(); ++f) all.push_back(f);
    return {cone.topology, cone.positions, {}, 0, all, normal};
}

TEST(VertexFan, HidesWhatLiesBehindItsFaces) {
    Directions directions{RandomStream(1)};
    size_t num_hidden = 0, num_open = 0, num_closed_in = 0;
    for (int trial = 0; trial < 300; ++trial) {
        Cone cone = random_cone(directions, 2 + trial % 5, trial % 2 == 0 ? 5.0 : 0.5);
        if (trial % 3 == 0) cone.turn_faces();
        const Vec3f normal = normal_at_apex(cone);
        const VertexFan fan = fan_of(cone, normal);
        num_closed_in += fan.most_open_direction(1e-3).isZero(0.0) ? 1 : 0;
        for (int j = 0; j < 300; ++j) {
            const Vec3d d = directions.next();
            const double height = cone.height(d);
            if (std::abs(height) < 1e-6) continue;
            ASSERT_EQ(fan.hides(d), height < 0.0) << trial << ' ' << height;
            ++(height < 0.0 ? num_hidden : num_open);
        }
    }
    EXPECT_GT(num_hidden, 20000u);
    EXPECT_GT(num_open, 20000u);
    EXPECT_GT(num_closed_in, 10u);  // no direction is in front of all faces
}

TEST(VertexFan, FindsTheMostOpenDirection) {
    Directions directions{RandomStream(2)};
    size_t num_found = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Cone cone = random_cone(directions, 2 + trial % 3, 2.0);
        const VertexFan fan = fan_of(cone, normal_at_apex(cone));
        double best = -1.0;  // of directions that get nearer and nearer to the best one
        Vec3d at(0, 0, 1);
        for (int j = 0; j < 4000; ++j) {
            const Vec3d d = (at + std::pow(0.998, j) * directions.next()).normalized();
            if (fan.clearance(d) <= best) continue;
            best = fan.clearance(d);
            at = d;
        }
        const Vec3d found = fan.most_open_direction(1e-3);
        if (found.isZero(0.0)) {
            EXPECT_LT(best, 1.1e-3);
            continue;
        }
        ++num_found;
        EXPECT_NEAR(found.norm(), 1.0, 1e-12);
        EXPECT_GE(fan.clearance(found), 0.899 * best);
    }
    EXPECT_GT(num_found, 60u);
}

// Every ray in the hemisphere of the normal against what the vertex sees, at any size and place.
void expect_rays_right(const Cone& shape, float scale, const Vec3f& far, Directions& directions,
                       double tolerance, size_t& num_fans) {
    Cone cone = shape;
    for (Vec3f& x : cone.positions) x = scale * (x + far);
    const Vec3f normal = normal_at_apex(cone);
    if (normal.isZero(0.0f)) return;
    std::vector<Vec3f> normals(cone.positions.size(), Vec3f::Zero());
    normals[0] = normal;
    const RayStarts starts(cone.topology, cone.positions, normals);
    num_fans += starts.num_fans();
    const RayScene scene(cone.topology, cone.positions);
    for (int j = 0; j < 200; ++j) {
        Vec3d d = directions.next();
        if (d.dot(normal.cast<double>()) < 0.0) d = -d;
        const double height = cone.height(d);
        if (std::abs(height) < tolerance) continue;
        const Vec3f f = d.cast<float>();
        float occluded = 0.0f;
        occluded_from(scene, starts[0], &f.x(), &f.y(), &f.z(), 1, &occluded);
        ASSERT_EQ(occluded, height < 0.0 ? 1.0f : 0.0f)
            << scale << ' ' << far.transpose() << ' ' << height << ' ' << starts.num_fans();
    }
}

TEST(RayStarts, RaysSeeWhatTheVertexSees) {
    Directions directions{RandomStream(3)};
    size_t num_fans = 0;
    for (int trial = 0; trial < 250; ++trial) {
        const double width = std::pow(10.0, 1.5 * directions.uniform());
        Cone cone = random_cone(directions, 2 + trial % 4, width);
        if (trial % 2 == 0) cone.turn_faces();
        // Where faces are so small that a start off the vertex sees past their far edges, rays
        // flatter than the offset (1e-2 of the shortest edge at most) may pass them.
        for (const float scale : {1e-30f, 1e-6f, 1.0f, 1e6f, 1e30f}) {
            expect_rays_right(cone, scale, {0, 0, 0}, directions, 1.1e-2, num_fans);
        }
        expect_rays_right(cone, 1.0f, {5, -3, 4}, directions, 1.1e-2, num_fans);
        expect_rays_right(cone, 1e-3f, {17, 17, -18}, directions, 1.1e-2, num_fans);
    }
    EXPECT_GT(num_fans, 50u);
    EXPECT_LT(num_fans, 1500u);
}

TEST(RayStarts, OfOrdinaryVerticesAreOnTheirNormals) {
    const PoseSet octopus = poses::make_octopus(2000, 1);
    const Pose pose = octopus.load_pose(0);
    const RayStarts starts(octopus.topology(), pose.positions, pose.normals);
    const auto offsets = ray_offsets(octopus.topology(), pose.positions);
    EXPECT_EQ(starts.num_fans(), 0u);
    size_t num_off_normal = 0;
    for (size_t v = 0; v < offsets.size(); ++v) {
        const Vec3d moved = starts[v].origin.cast<double>() - pose.positions[v].cast<double>();
        const Vec3d normal = pose.normals[v].cast<double>();
        const double distance = moved.dot(normal);
        // Two roundings of coordinates of a few units.
        if ((moved - distance * normal).norm() > 1e-6) {
            ++num_off_normal;
            continue;
        }
        // Where rounding decides, faces that are less than 90° from the normal take it further.
        EXPECT_GT(distance, double{offsets[v]} - 1e-6) << v;
        EXPECT_LT(distance, 4.0 * double{offsets[v]} + 1e-6) << v;
    }
    EXPECT_LE(num_off_normal, 16u);  // the tips of the arms
}

TEST(RayStarts, AreTheSameForAnyOrderOfFacesAndForFacesThatAreThereTwice) {
    Directions directions{RandomStream(4)};
    for (int trial = 0; trial < 50; ++trial) {
        const Cone cone = random_cone(directions, 4, 3.0);
        Topology other = cone.topology;
        for (const Triangle& t : cone.topology.triangles)
            other.triangles.push_back({t[2], t[0], t[1]});
        other.triangles.push_back({cone.topology.triangles[0][1], 0, 2});  // a back of the first
        std::vector<Vec3f> normals(cone.positions.size(), Vec3f::Zero());
        normals[0] = normal_at_apex(cone);
        const RayStarts a(cone.topology, cone.positions, normals);
        const RayStarts b(other, cone.positions, normals);
        EXPECT_EQ(a[0].origin, b[0].origin);
        ASSERT_EQ(a.num_fans(), b.num_fans());
        if (a.num_fans() == 0) continue;
        for (int j = 0; j < 100; ++j) {
            const Vec3d d = directions.next();
            EXPECT_EQ(a[0].fan->hides(d), b[0].fan->hides(d));
        }
    }
}

}  // namespace
}  // namespace paim
