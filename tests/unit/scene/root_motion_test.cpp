// Finding the root motion of a sequence.
#include "compressor/scene/root_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "compressor/scene/rigid_fit.h"
#include "paim/base/seed.h"
#include "paim/base/tbb_parallel.h"
#include "paim/format/container/root_numbers.h"
#include "paim/mesh/pose_set.h"

namespace paim {
namespace {

std::vector<Vec3d> random_points(size_t count, uint64_t seed) {
    RandomStream random(seed);
    std::vector<Vec3d> points;
    for (size_t v = 0; v < count; ++v) {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        points.emplace_back(x, 2.0 * y, 3.0 * z);
    }
    return points;
}

RigidTransform some_transform() {
    return {Eigen::Quaterniond(Eigen::AngleAxisd(2.1, Vec3d(1, 2, -1).normalized())),
            Vec3d(4, -5, 600)};
}

std::vector<Vec3d> moved(const std::vector<Vec3d>& points, const RigidTransform& by) {
    std::vector<Vec3d> result;
    for (const Vec3d& point : points) result.push_back(by.to_scene(point));
    return result;
}

void expect_near(const RigidTransform& got, const RigidTransform& expected, double tolerance) {
    EXPECT_LT(got.rotation.angularDistance(expected.rotation), tolerance);
    EXPECT_LT((got.translation - expected.translation).norm(), tolerance * 600.0);
}

TEST(FitRigid, IsExactForARigidBody) {
    const std::vector<Vec3d> from = random_points(50, 1);
    expect_near(fit_rigid(from, moved(from, some_transform())), some_transform(), 1e-9);
}

TEST(FitRigid, IsNotTurnedByOutliersOrALimb) {
    const std::vector<Vec3d> from = random_points(100, 2);
    std::vector<Vec3d> to = moved(from, some_transform());
    for (size_t v = 0; v < 25; ++v) to[v] += Vec3d(0.3, 0.8, -0.2);  // a quarter swings
    to[70] += Vec3d(5000, 4000, 0);
    to[71] = Vec3d(1e30, -1e30, 1e30);
    expect_near(fit_rigid(from, to), some_transform(), 1e-6);
}

// What is on a line or in a point says nothing about turns about it.
TEST(FitRigid, TurnsNoMoreThanThePointsSay) {
    const std::vector<Vec3d> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}};
    const RigidTransform along = fit_rigid(line, line);
    EXPECT_LT(along.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-6);
    const std::vector<Vec3d> point(4, Vec3d(1, 2, 3)), place(4, Vec3d(1, 2, 8));
    const RigidTransform still = fit_rigid(point, place);
    EXPECT_LT(still.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-12);
    EXPECT_LT((still.to_scene({1, 2, 3}) - Vec3d(1, 2, 8)).norm(), 1e-12);
}

TEST(FitRigid, NeverMirrors) {
    const std::vector<Vec3d> from = random_points(40, 3);
    std::vector<Vec3d> mirrored = from;
    for (Vec3d& point : mirrored) point.x() = -point.x();
    EXPECT_GT(fit_rigid(from, mirrored).rotation.toRotationMatrix().determinant(), 0.999);
}

TEST(FitTranslation, DoesNotTurn) {
    const std::vector<Vec3d> from = random_points(40, 4);
    EXPECT_FALSE(fit_translation(from, moved(from, some_transform())).turns());
}

// A box of triangles whose points are moved by a function of pose and point.
PoseSet animated(const std::function<Vec3d(uint32_t, const Vec3d&)>& at, uint32_t num_poses = 8) {
    const std::vector<Vec3d> shape = random_points(60, 5);
    Topology topology{60, {}};
    for (uint32_t v = 0; v < 60; v += 3) topology.triangles.push_back({v, v + 1, v + 2});
    std::vector<std::vector<Vec3f>> poses(num_poses);
    for (uint32_t p = 0; p < num_poses; ++p) {
        for (const Vec3d& point : shape) poses[p].push_back(at(p, point).cast<float>());
    }
    return PoseSet(topology, poses);
}

Vec3d swing(uint32_t p, const Vec3d& point) {
    return {point.x() + 0.2 * (point.z() - 1.5) * std::sin(p), point.y(), point.z()};
}

Vec3d turned(double angle_rad, const Vec3d& point) {
    return Eigen::AngleAxisd(angle_rad, Vec3d::UnitY()) * point;
}

TEST(FindRootMotion, LeavesABodyThatStaysInItsPlace) {
    EXPECT_TRUE(find_root_motion(animated(&swing), RootMotionChoice::automatic).empty());
}

TEST(FindRootMotion, TakesOutAPath) {
    const PoseSet walk = animated(
        [](uint32_t p, const Vec3d& point) { return Vec3d(swing(p, point) + p * Vec3d(2, 0, 1)); });
    const RootMotion motion = find_root_motion(walk, RootMotionChoice::automatic);
    ASSERT_EQ(motion.size(), 8u);
    for (uint32_t p = 0; p < 8; ++p) {
        EXPECT_FALSE(motion[p].turns());
        EXPECT_NEAR(motion[p].translation.x() - motion[0].translation.x(), 2.0 * p, 0.3) << p;
        EXPECT_NEAR(motion[p].translation.z() - motion[0].translation.z(), 1.0 * p, 1e-3) << p;
    }
}

TEST(FindRootMotion, TakesOutTurns) {
    const PoseSet spin = animated([](uint32_t p, const Vec3d& point) { return turned(p, point); });
    const RootMotion motion = find_root_motion(spin, RootMotionChoice::automatic);
    ASSERT_EQ(motion.size(), 8u);
    const Pose first = spin.load_pose(0);
    for (uint32_t p = 0; p < 8; ++p) {
        const Pose pose = spin.load_pose(p);
        for (size_t v = 0; v < 60; ++v) {
            const Vec3d local = motion[p].to_local(pose.positions[v].cast<double>());
            const Vec3d same = motion[0].to_local(first.positions[v].cast<double>());
            EXPECT_LT((local - same).norm(), 3e-6) << p;
        }
    }
}

// One vertex far away decides nothing, even in the first pose.
TEST(FindRootMotion, SeesPastAnOutlier) {
    for (const uint32_t bad : {0u, 3u}) {
        const PoseSet walk = animated([&](uint32_t p, const Vec3d& point) {
            const bool is_out = p == bad && point == random_points(60, 5)[7];
            return is_out ? Vec3d(1e30, 4000, 0) : Vec3d(swing(p, point) + p * Vec3d(2, 0, 0));
        });
        const RootMotion motion = find_root_motion(walk, RootMotionChoice::automatic);
        ASSERT_EQ(motion.size(), 8u) << bad;
        const double path = motion[7].translation.x() - motion[0].translation.x();
        EXPECT_NEAR(path, 14.0, 0.3) << bad;
    }
}

// A half turn is on the edge between two rotation vectors, one for each direction of its axis.
TEST(FindRootMotion, GivesNumbersThatFilesKeep) {
    for (const double around : {-3e-7, -1e-7, 0.0, 1e-7, 3e-7}) {
        for (const Vec3d& axis : {Vec3d(0.1, 1, 0), Vec3d(0, 1, 0), Vec3d(-3, 1, 2)}) {
            const PoseSet turns = animated([&](uint32_t p, const Vec3d& point) {
                const Eigen::AngleAxisd turn(p % 2 * (kPi + around), axis.normalized());
                return Vec3d(turn * point);
            });
            const RootMotion motion = find_root_motion(turns, RootMotionChoice::rigid);
            const std::vector<double> numbers = root_numbers(motion);
            const RootMotion read = root_motion_of(numbers, "x");
            EXPECT_EQ(read, motion);
            EXPECT_EQ(root_numbers(read), numbers);
        }
    }
}

// A path beyond which doubles hold little of the shape.
TEST(FindRootMotion, TakesOutAPathOfAnyLength) {
    for (const double step : {1e3, 1e7, 1e12}) {
        const PoseSet far = animated([&](uint32_t p, const Vec3d& point) {
            return Vec3d(swing(p, point) + step * p * Vec3d(1, 0, 0.5));
        });
        EXPECT_EQ(find_root_motion(far, RootMotionChoice::automatic).size(), 8u) << step;
    }
}

TEST(FindRootMotion, TakesOutPathsOfManyKinds) {
    using Path = std::function<Vec3d(uint32_t)>;
    const std::vector<std::pair<const char*, Path>> paths{
        {"climbs stairs", [](uint32_t p) { return Vec3d(2.0 * p, 1.5 * (p / 2), 0); }},
        {"walks to and fro", [](uint32_t p) { return Vec3d(0, 0, 5.0 * std::min(p, 8 - p)); }},
        {"begins again", [](uint32_t p) { return Vec3d(5.0 * (p % 4), 0, 0); }}};
    for (const auto& [name, path] : paths) {
        const PoseSet walk = animated([&path = path](uint32_t p, const Vec3d& point) {
            return Vec3d(swing(p, point) + path(p));
        });
        const RootMotion motion = find_root_motion(walk, RootMotionChoice::automatic);
        ASSERT_EQ(motion.size(), 8u) << name;
        for (uint32_t p = 0; p < 8; ++p) {
            const Vec3d moved = motion[p].translation - motion[0].translation;
            EXPECT_LT((moved - path(p) + path(0)).norm(), 0.3) << name << ' ' << p;  // the swing
        }
    }
}

// The pose is an outlier then, and is coded as one.
TEST(FindRootMotion, PutsAJumpBackOnThePath) {
    for (const uint32_t bad : {0u, 4u, 7u}) {
        const PoseSet walk = animated([&](uint32_t p, const Vec3d& point) {
            const Vec3d jump = p == bad ? Vec3d(1e6, 2e5, 0) : Vec3d::Zero();
            return Vec3d(swing(p, point) + p * Vec3d(2, 0, 0) + jump);
        });
        const RootMotion motion = find_root_motion(walk, RootMotionChoice::automatic);
        ASSERT_EQ(motion.size(), 8u) << bad;
        for (uint32_t p = 0; p < 8; ++p) {
            EXPECT_NEAR(motion[p].translation.x(), 2.0 * p, 3.0) << bad << ' ' << p;
        }
    }
}

TEST(FindRootMotion, LooksAtTheFirstPoseThatHasASize) {
    const PoseSet walk = animated([](uint32_t p, const Vec3d& point) {
        return Vec3d((p == 0 ? 0.0 : 1.0) * swing(p, point) + p * Vec3d(20, 0, 0));
    });
    const RootMotion motion = find_root_motion(walk, RootMotionChoice::automatic);
    ASSERT_EQ(motion.size(), 8u);
    EXPECT_NEAR(motion[7].translation.x() - motion[1].translation.x(), 120.0, 0.5);
}

TEST(FindRootMotion, FollowsNoSmallTurns) {
    const auto rocking = [](double angle_deg) {
        return animated([=](uint32_t p, const Vec3d& point) {
            return Vec3d(turned(angle_deg * kPi / 180.0 * (p % 2), point) + p * Vec3d(2, 0, 0));
        });
    };
    EXPECT_FALSE(find_root_motion(rocking(10.0), RootMotionChoice::automatic)[1].turns());
    EXPECT_TRUE(find_root_motion(rocking(30.0), RootMotionChoice::automatic)[1].turns());
}

// With a floor the first pose stays where it is, and others are there in local coordinates, too.
TEST(FindRootMotion, MayKeepTheReferenceInItsPlace) {
    const PoseSet spin = animated([](uint32_t p, const Vec3d& point) {
        return Vec3d(turned(p, point) + Vec3d(300 + 2.0 * p, 0, -70));
    });
    const RootMotion motion =
        find_root_motion(spin, RootMotionChoice::automatic, {}, LocalOrigin::reference);
    ASSERT_EQ(motion.size(), 8u);
    EXPECT_TRUE(motion[0].is_identity());
    const Pose first = spin.load_pose(0);
    for (uint32_t p = 0; p < 8; ++p) {
        const Pose pose = spin.load_pose(p);
        for (size_t v = 0; v < 60; ++v) {
            const Vec3d local = motion[p].to_local(pose.positions[v].cast<double>());
            // Rotations of 2^-22, 300 units away, and floats of 300.
            EXPECT_LT((local - first.positions[v].cast<double>()).norm(), 5e-4) << p;
        }
    }
}

TEST(FindRootMotion, NeedsNoSizeInAnyPose) {
    const PoseSet grows = animated([](uint32_t p, const Vec3d& point) {
        return Vec3d(0.1 * p * (point - Vec3d(0.5, 1.0, 1.5)));
    });
    EXPECT_TRUE(find_root_motion(grows, RootMotionChoice::automatic).empty());
    const PoseSet point = animated([](uint32_t, const Vec3d&) { return Vec3d(1, 2, 3); });
    EXPECT_TRUE(find_root_motion(point, RootMotionChoice::automatic).empty());
    EXPECT_EQ(find_root_motion(point, RootMotionChoice::rigid).size(), 8u);
}

TEST(FindRootMotion, FollowsTheChoice) {
    const PoseSet spin = animated([](uint32_t p, const Vec3d& point) { return turned(p, point); });
    EXPECT_TRUE(find_root_motion(spin, RootMotionChoice::none).empty());
    EXPECT_FALSE(find_root_motion(spin, RootMotionChoice::translation)[3].turns());
    EXPECT_TRUE(find_root_motion(animated(&swing), RootMotionChoice::rigid)[3].turns());
    const PoseSet one = animated(&swing, 1);
    EXPECT_TRUE(find_root_motion(one, RootMotionChoice::rigid).empty());
}

TEST(FindRootMotion, IsTheSameOnAnyNumberOfThreads) {
    const PoseSet walk = animated([](uint32_t p, const Vec3d& point) {
        return Vec3d(turned(0.4 * p, swing(p, point)) + p * Vec3d(2, 0, 1));
    });
    RootMotion motions[2];
    for (int j = 0; j < 2; ++j) {
        const ThreadLimit limit(j == 0 ? 1 : 4);
        motions[j] = find_root_motion(walk, RootMotionChoice::automatic);
    }
    EXPECT_EQ(motions[0], motions[1]);
    EXPECT_TRUE(motions[0][3].turns());
}

}  // namespace
}  // namespace paim
