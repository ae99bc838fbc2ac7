// Cameras that see all of something: exact for known points; the path that a camera follows; crowds.
#include "player/view/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <vector>

#include "paim/base/seed.h"
#include "paim/codec/sequence_bounds.h"
#include "player/view/body_path.h"
#include "player/view/crowd.h"
#include "player/view/orbit_camera.h"
#include "player/view/pose_bounds_cache.h"
#include "tests/player/test_asset.h"

namespace paim::player {
namespace {

struct Direction {
    float azimuth_rad, elevation_rad, aspect;
};

const std::vector<Direction> kViews{{0.0f, 0.0f, 1.0f},   {0.5f, 0.3f, 16.0f / 9.0f},
                                    {-2.0f, 1.5f, 0.4f},  {3.0f, -1.2f, 3.0f},
                                    {1.0f, -0.4f, 0.05f}, {-0.7f, 0.9f, 20.0f}};

// The box of the points in the picture, as distances from its middle: 1 at its edges.
struct Silhouette {
    double left = -INFINITY, right = -INFINITY, up = -INFINITY, down = -INFINITY;
    bool visible = true;

    double widest() const { return std::max(left, right); }
    double highest() const { return std::max(up, down); }
};

Silhouette silhouette(const Camera& camera, float aspect, const std::vector<Vec3d>& points) {
    Silhouette box;
    for (const Vec3d& point : points) {
        const auto place = project(camera, aspect, point.cast<float>());
        box.visible = box.visible && place.has_value();
        if (!place) continue;
        const double x = 2.0 * place->x() - 1.0, y = 1.0 - 2.0 * place->y();
        box.right = std::max(box.right, x);
        box.left = std::max(box.left, -x);
        box.up = std::max(box.up, y);
        box.down = std::max(box.down, -y);
    }
    return box;
}

Camera fit(const Direction& view, const std::vector<Vec3d>& points, float fill = kFill) {
    FrustumFit fit(view.azimuth_rad, view.elevation_rad, view.aspect, fill);
    for (const Vec3d& point : points) fit.add(point);
    return fit.camera();
}

std::vector<Vec3d> random_points(int count, uint64_t seed) {
    RandomStream random(stream_key(7, seed, 0));
    std::vector<Vec3d> points;
    for (int i = 0; i < count; ++i) {
        points.emplace_back(3.0 * random.uniform(), random.uniform(), 2.0 * random.uniform());
    }
    return points;
}

// Whether the fit is not exact: the camera would be at the nearest point.
bool nearly_behind_each_other(const Camera& camera, const std::vector<Vec3d>& points) {
    double nearest = INFINITY, farthest = 0.0;
    for (const Vec3d& point : points) {
        const auto place = project(camera, 1.0f, point.cast<float>());
        nearest = std::min(nearest, double{place->z()});
        farthest = std::max(farthest, double{place->z()});
    }
    return nearest < 0.01 * farthest;
}

TEST(FrustumFit, TouchesFourFifthsAndNoMore) {
    for (const Direction& view : kViews) {
        for (const int count : {2, 3, 100}) {
            for (uint64_t seed = 0; seed < 10; ++seed) {
                const std::vector<Vec3d> points = random_points(count, seed);
                const Camera camera = fit(view, points);
                const Silhouette box = silhouette(camera, view.aspect, points);
                ASSERT_TRUE(box.visible);
                if (nearly_behind_each_other(camera, points)) {
                    EXPECT_LE(std::max(box.widest(), box.highest()), double{kFill} + 1e-3);
                    continue;
                }
                // Eye and target are floats: of points of size 4 at a distance of 10 and more they are
                // off by 1e-6 of it; in a picture 20 times as high as wide that is 2e-5 of its width.
                const double rounding = 4e-5;
                const bool across = box.widest() > box.highest();
                EXPECT_NEAR(std::max(box.widest(), box.highest()), double{kFill}, rounding);
                EXPECT_NEAR(across ? box.left : box.up, double{kFill}, rounding);
                EXPECT_NEAR(across ? box.right : box.down, double{kFill}, rounding);
            }
        }
    }
}

// A square, seen from the front: in closed form.
TEST(FrustumFit, IsExactForASquare) {
    const std::vector<Vec3d> square{{1, 3, 2}, {-1, 3, 2}, {1, 5, 2}, {-1, 5, 2}};
    for (const float aspect : {0.5f, 1.0f, 2.0f}) {
        for (const float fill : {0.25f, kFill, 1.0f}) {
            const Camera camera = fit({0.0f, 0.0f, aspect}, square, fill);
            const float t = fill * std::tan(0.5f * camera.vertical_fov_rad);
            const float distance = 1.0f / (t * std::min(1.0f, aspect));
            EXPECT_LE((camera.target - Vec3f(0, 4, 2)).norm(), 1e-6f);
            EXPECT_LE((camera.eye - Vec3f(0, 4, 2 + distance)).norm(), 2e-6f * distance);
        }
    }
}

// The nearer of two points of a line of sight decides: with both at the edge, further away is smaller.
TEST(FrustumFit, CountsDepth) {
    const std::vector<Vec3d> wedge{{-1, 0, 5}, {1, 0, 5}, {-1, 0, -50}, {1, 0, -50}};
    const Camera camera = fit({0.0f, 0.0f, 1.0f}, wedge);
    const float t = kFill * std::tan(0.5f * camera.vertical_fov_rad);
    EXPECT_NEAR(camera.eye.z(), 5.0f + 1.0f / t, 1e-5f);
    EXPECT_NEAR(camera.target.z(), -22.5f, 1e-5f);
}

TEST(FrustumFit, LooksAtASinglePointFromSomewhere) {
    for (const Direction& view : kViews) {
        const Vec3d point(5.0, -3.0, 2.0);
        const Camera camera = fit(view, {point});
        EXPECT_LE((camera.target - point.cast<float>()).norm(), 1e-5f);
        EXPECT_NEAR((camera.eye - camera.target).norm(), 1.0f, 1e-5f);
        const auto place = project(camera, view.aspect, point.cast<float>());
        ASSERT_TRUE(place);
        EXPECT_NEAR(place->x(), 0.5f, 1e-4f);
        EXPECT_NEAR(place->y(), 0.5f, 1e-4f);
        const Camera none = fit(view, {});
        EXPECT_TRUE(none.eye.allFinite());
        EXPECT_EQ(none.target, Vec3f(Vec3f::Zero()));
        EXPECT_NEAR(none.eye.norm(), 1.0f, 1e-6f);
    }
}

// Points on one line of sight have no size in the picture. All of them are seen nevertheless.
TEST(FrustumFit, SeesPointsBehindEachOther) {
    const std::vector<Vec3d> points{{0, 0, 1}, {0, 0, 0}, {0, 0, -3}};
    const Camera camera = fit({0.0f, 0.0f, 1.0f}, points);
    EXPECT_TRUE(silhouette(camera, 1.0f, points).visible);
}

TEST(FrustumFit, WorksFarFromTheOrigin) {
    for (const Direction& view : kViews) {
        std::vector<Vec3d> points = random_points(50, 3);
        for (Vec3d& point : points)
            point = (point + Vec3d(400.0, -300.0, 800.0)).cast<float>().cast<double>();
        const Silhouette box = silhouette(fit(view, points), view.aspect, points);
        // Floats of 1000 are 6e-5 apart: of a picture that is at least 0.1 wide and high.
        const double rounding = view.aspect < 0.1f || view.aspect > 10.0f ? 2e-2 : 1e-3;
        EXPECT_NEAR(std::max(box.widest(), box.highest()), double{kFill}, rounding);
    }
}

TEST(Project, IsTheInverseOfRayDirection) {
    for (const Direction& view : kViews) {
        const Camera camera = fit(view, random_points(20, 1));
        for (const float u : {0.0f, 0.25f, 0.5f, 1.0f}) {
            for (const float v : {0.0f, 0.4f, 1.0f}) {
                const Vec3f direction = camera.ray_direction(u, v, view.aspect);
                const Vec3f point = camera.eye + 3.0f * direction;
                const auto place = project(camera, view.aspect, point);
                ASSERT_TRUE(place);
                // The point is rounded to a float of its distance from the origin, up to 400 times as far as
                // it is from the eye in the narrowest picture.
                const float rounding =
                    4e-7f * (camera.eye.norm() + 3.0f) / std::min(1.0f, view.aspect);
                EXPECT_NEAR(place->x(), u, rounding);
                EXPECT_NEAR(place->y(), v, 4e-7f * (camera.eye.norm() + 3.0f));
                const float along = -direction.dot(camera.axes().col(2));
                EXPECT_NEAR(place->z(), 3.0f * along, 1e-6f * (camera.eye.norm() + 3.0f));
                EXPECT_FALSE(project(camera, view.aspect, camera.eye - 3.0f * direction));
            }
        }
        EXPECT_FALSE(project(camera, view.aspect, camera.eye));
    }
}

TEST(OrbitCameraOfACamera, LooksTheSameWay) {
    for (const Direction& view : kViews) {
        const Camera camera = fit(view, random_points(20, 2));
        const Camera same = OrbitCamera::of(camera).camera();
        EXPECT_LE((same.eye - camera.eye).norm(), 1e-5f * (1.0f + camera.eye.norm()));
        EXPECT_LE((same.target - camera.target).norm(), 1e-5f);
    }
}

// Positions of all vertices of the moving part in the scene.
std::vector<Vec3d> places(const Asset& asset, double time) {
    const CodedMesh& mesh = asset.moving();
    PositionDecoder decoder;
    std::vector<float> planes;
    decoder.decode(mesh.positions, time, mesh.positions.num_components, planes);
    const RigidTransform root = root_at(mesh.root_motion, time);
    const size_t n = mesh.topology.num_vertices;
    std::vector<Vec3d> points;
    for (const uint32_t v : body_vertices(mesh)) {
        points.push_back(root.to_scene(Vec3d(planes[v], planes[n + v], planes[2 * n + v])));
    }
    return points;
}

Asset travelling_asset() {
    TestAssetOptions options;
    options.num_poses = 40;
    Asset asset = make_test_asset(options);
    for (uint32_t p = 0; p < options.num_poses; ++p) {
        asset.moving().root_motion.push_back(
            {Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * p, Vec3d::UnitY())),
             Vec3d(0.5 * p, 0.1 * p, -0.3 * p)});
    }
    return asset;
}

TEST(FrameAsset, FillsFourFifthsOverAllPoses) {
    const Asset asset = travelling_asset();
    for (const Direction& view : kViews) {
        const Camera camera = frame_asset(asset, view.azimuth_rad, view.elevation_rad, view.aspect);
        double most = 0.0;
        for (uint32_t p = 0; p < asset.num_poses(); ++p) {
            const Silhouette box = silhouette(camera, view.aspect, places(asset, p));
            EXPECT_TRUE(box.visible);
            most = std::max({most, box.widest(), box.highest()});
        }
        EXPECT_NEAR(most, double{kFill}, 2e-3);
        const Camera of_pose =
            frame_pose(asset, 17.5, view.azimuth_rad, view.elevation_rad, view.aspect);
        const Silhouette box = silhouette(of_pose, view.aspect, places(asset, 17.5));
        EXPECT_NEAR(std::max(box.widest(), box.highest()), double{kFill}, 2e-3);
    }
}

// A camera that goes along sees the body in every pose, and comes as near as one that stands still.
TEST(FrameAsset, FollowsThePath) {
    const Asset asset = travelling_asset();
    BodyPath path(asset);
    const Direction view{0.5f, 0.3f, 1.5f};
    const OrbitCamera orbit = OrbitCamera::of(
        frame_asset(asset, view.azimuth_rad, view.elevation_rad, view.aspect, &path));
    double most = 0.0;
    for (uint32_t p = 0; p < asset.num_poses(); ++p) {
        const Silhouette box = silhouette(orbit.camera(path.at(p)), view.aspect, places(asset, p));
        EXPECT_TRUE(box.visible);
        most = std::max({most, box.widest(), box.highest()});
    }
    EXPECT_NEAR(most, double{kFill}, 1e-3);
    const Camera still = frame_asset(asset, view.azimuth_rad, view.elevation_rad, view.aspect);
    EXPECT_LT(orbit.distance, 0.5 * double{(still.eye - still.target).norm()});
}

// A floor is not what a camera is to see.
TEST(FrameAsset, LeavesFloorsOut) {
    Asset asset = travelling_asset();
    CodedMesh& mesh = asset.moving();
    const Camera before = frame_asset(asset, 0.5f, 0.3f, 1.5f);
    BodyPath path_before(asset);
    const Vec3d middle = path_before.at(20.0);
    // The last three of nine rings become a floor: their vertices may be anywhere.
    const uint32_t num_floor = 3 * 16;
    mesh.num_following = mesh.topology.num_vertices - num_floor;
    EXPECT_EQ(body_vertices(mesh).size(), mesh.num_following);
    const Camera without = frame_asset(asset, 0.5f, 0.3f, 1.5f);
    EXPECT_TRUE(without.eye != before.eye);
    BodyPath path(asset);
    EXPECT_TRUE(path.at(20.0) != middle);
    std::vector<float> mean = mesh.positions.mean_floats();
    for (uint32_t v = mesh.num_following; v < mesh.topology.num_vertices; ++v) mean[v] += 1000.0f;
    mesh.positions.mean = mean;
    EXPECT_EQ(frame_asset(asset, 0.5f, 0.3f, 1.5f).eye, without.eye);
    EXPECT_EQ(BodyPath(asset).at(20.0), path.at(20.0));
}

TEST(BodyPath, IsExactForStraightMotion) {
    TestAssetOptions options;
    options.num_poses = 40;
    options.geometry_components = 0;
    Asset asset = make_test_asset(options);
    const Vec3d step(0.5, -0.25, 3.0);
    for (uint32_t p = 0; p < options.num_poses; ++p) {
        asset.moving().root_motion.push_back({Eigen::Quaterniond::Identity(), p * step});
    }
    BodyPath path(asset);
    const Vec3d start = path.at(0.0);
    EXPECT_LE(start.norm(), 1e-6);  // of a sphere about the origin
    for (double time = 0.0; time <= 39.0; time += 0.375) {
        EXPECT_LE((path.at(time) - start - time * step).norm(), 1e-12 * (1.0 + time)) << time;
    }
    EXPECT_EQ(path.at(-5.0), path.at(0.0));
    EXPECT_EQ(path.at(100.0), path.at(39.0));
}

// What swings about the path within half a second is averaged away.
TEST(BodyPath, IsSmooth) {
    TestAssetOptions options;
    options.num_poses = 60;
    options.geometry_components = 0;
    Asset asset = make_test_asset(options);  // 24 poses a second: averages over 13 poses
    for (uint32_t p = 0; p < options.num_poses; ++p) {
        const Vec3d swing(p % 2 == 0 ? 0.1 : -0.1, 0.0, 0.0);
        asset.moving().root_motion.push_back(
            {Eigen::Quaterniond::Identity(), Vec3d(0.0, 0.0, 0.2 * p) + swing});
    }
    BodyPath path(asset);
    for (double time = 6.0; time <= 53.0; time += 0.5) {
        // Of 13 alternating values 12 cancel.
        EXPECT_LE(std::abs(path.at(time).x()), 0.1 / 13.0 + 1e-6) << time;
        EXPECT_NEAR(path.at(time).z(), 0.2 * time, 1e-6) << time;
    }
    EXPECT_NEAR(path.at(0.0).x(), 0.1, 1e-6);  // as many poses on either side: none
    Asset slow = asset;
    slow.frames_per_second = 1.0f;  // nothing within half a second
    EXPECT_NEAR(BodyPath(slow).at(30.0).x(), 0.1, 1e-6);
}

TEST(PoseBoundsCache, HoldsEveryMoment) {
    const Asset asset = travelling_asset();
    PoseBoundsCache cache(asset);
    for (const uint32_t components : {3u, 0u, 1u}) {
        for (const double time : {0.0, 2.5, 3.0, 38.99, 39.0, 50.0}) {
            const Bounds bounds = cache.at(time, components);
            const double shown = std::min(time, 39.0);
            const Bounds before = pose_bounds(asset, std::floor(shown), components);
            const Bounds after = pose_bounds(asset, std::ceil(shown), components);
            EXPECT_EQ(bounds.lower, Vec3f(before.lower.cwiseMin(after.lower)));
            EXPECT_EQ(bounds.upper, Vec3f(before.upper.cwiseMax(after.upper)));
        }
    }
}

Bounds box(const Vec3f& lower, const Vec3f& upper) {
    Bounds bounds;
    bounds.extend(lower);
    bounds.extend(upper);
    return bounds;
}

TEST(Crowd, StandsApartAndMovesApart) {
    for (const Bounds& reach :
         {box({-1, 0, -2}, {3, 5, 1}), box({-1, 0, 2}, {3, 5, 2}), box({1, 1, 1}, {1, 1, 1}),
          box({-1e-6f, 0, 0}, {1e-6f, 2e-6f, 0}), box({-900, 0, 0}, {-899, 2, 1})}) {
        for (const uint32_t count : {1u, 2u, 3u, 4u, 5u, 9u, 10u, 257u}) {
            const std::vector<Instance> crowd = make_crowd(count, reach, 100);
            ASSERT_EQ(crowd.size(), count);
            EXPECT_TRUE(crowd[0].offset.isZero(0.0));
            EXPECT_EQ(crowd[0].time_offset, 0.0);
            std::set<double> times;
            const Vec3d size = (reach.upper - reach.lower).cast<double>();
            for (uint32_t i = 0; i < count; ++i) {
                times.insert(crowd[i].time_offset);
                EXPECT_GE(crowd[i].time_offset, 0.0);
                EXPECT_LT(crowd[i].time_offset, 100.0);
                EXPECT_EQ(crowd[i].offset.y(), 0.0);
                for (uint32_t j = 0; j < i; ++j) {
                    const Vec3d apart = (crowd[i].offset - crowd[j].offset).cwiseAbs();
                    ASSERT_TRUE(apart.x() > size.x() || apart.z() > size.z())
                        << i << ' ' << j << ' ' << size.transpose();
                }
            }
            EXPECT_EQ(times.size(), count);
            const Bounds all = crowd_bounds(crowd, reach);
            for (const Instance& instance : crowd) {
                const Vec3f offset = instance.offset.cast<float>();
                EXPECT_TRUE(((reach.lower + offset).array() >= all.lower.array()).all());
                EXPECT_TRUE(((reach.upper + offset).array() <= all.upper.array()).all());
            }
        }
    }
}

TEST(Crowd, IsSquareAboutTheFirst) {
    const Bounds reach = box({0, 0, 0}, {1, 1, 2});
    const std::vector<Instance> crowd = make_crowd(9, reach, 10);
    Bounds middles;
    for (const Instance& instance : crowd) middles.extend(instance.offset.cast<float>());
    EXPECT_TRUE(middles.center().isZero(1e-6f));
    EXPECT_NEAR(middles.upper.x(), 1.1f, 1e-6f);
    EXPECT_NEAR(middles.upper.z(), 2.2f, 1e-6f);
    EXPECT_EQ(make_crowd(0, reach, 10).size(), 1u);
    EXPECT_EQ(make_crowd(9, Bounds(), 10).size(), 1u);
    EXPECT_TRUE(crowd_bounds(crowd, Bounds()).empty());
}

}  // namespace
}  // namespace paim::player
