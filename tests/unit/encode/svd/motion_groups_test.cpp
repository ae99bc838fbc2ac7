// Groups of vertices that move together.
#include "compressor/encode/svd/motion_groups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "paim/base/vector.h"

namespace paim {
namespace {

constexpr uint32_t kSteps = 12;

// Strips of so many vertices, and their positions: pieces are one unit long, each at its place.
class Scene {
  public:
    using Path = std::function<Vec3d(double time)>;  // time in radians

    void add(uint32_t num_vertices, const Path& path) {
        Topology strip{num_vertices, {}};
        for (uint32_t v = 0; v + 2 < num_vertices; ++v)
            strip.triangles.push_back({v, v + 1, v + 2});
        topology_.append(strip);
        for (uint32_t v = 0; v < num_vertices; ++v) {
            const double along = static_cast<double>(v) / num_vertices;
            points_.push_back(
                [=](double time) { return Vec3d(path(time) + along * Vec3d::UnitY()); });
        }
    }
    void add_isolated(uint32_t count) {
        topology_.num_vertices += count;
        for (uint32_t j = 0; j < count; ++j) {
            points_.push_back([](double) { return Vec3d(Vec3d::Zero()); });
        }
    }

    std::vector<uint32_t> groups() const {
        const auto num_vertices = static_cast<Eigen::Index>(points_.size());
        Eigen::MatrixXf matrix(3 * num_vertices, kSteps);
        for (Eigen::Index v = 0; v < num_vertices; ++v) {
            for (Eigen::Index p = 0; p < kSteps; ++p) {
                const Vec3d x = points_[static_cast<size_t>(v)](2.0 * kPi * p / kSteps);
                for (Eigen::Index axis = 0; axis < 3; ++axis) {
                    matrix(axis * num_vertices + v, p) = static_cast<float>(x[axis]);
                }
            }
        }
        return motion_groups(topology_, MatrixRows(matrix));
    }

  private:
    Topology topology_{0, {}};
    std::vector<std::function<Vec3d(double)>> points_;
};

Vec3d still(double) {
    return Vec3d::Zero();
}

TEST(MotionGroups, AreLargePieces) {
    Scene scene;
    scene.add(400, still);
    scene.add(300, still);
    for (int j = 0; j < 10; ++j) scene.add(30, still);
    std::vector<uint32_t> group = scene.groups();
    EXPECT_EQ(group[0], 1u);
    EXPECT_EQ(group[399], 1u);
    EXPECT_EQ(group[400], 2u);
    for (size_t v = 700; v < 1000; ++v) EXPECT_EQ(group[v], 3u) << v;
    // What has no face counts for nothing.
    scene.add_isolated(9000);
    const std::vector<uint32_t> more = scene.groups();
    EXPECT_TRUE(std::equal(group.begin(), group.end(), more.begin()));
}

// Each of 30 walks its own way.
TEST(MotionGroups, AreTheWalkersOfACrowd) {
    Scene scene;
    for (int j = 0; j < 30; ++j) {
        const double way = 2.0 * kPi * j / 30.0;
        scene.add(10, [=](double time) {
            return Vec3d(50.0 * time * Vec3d(std::sin(way), 0.0, std::cos(way)));
        });
    }
    const std::vector<uint32_t> group = scene.groups();
    for (uint32_t j = 0; j < 30; ++j) EXPECT_EQ(group[10 * j], j + 1);
}

// Two robots of 20 parts each, which swing by less than they are large, walk apart.
TEST(MotionGroups, AreBodiesOfManyParts) {
    Scene scene;
    for (int j = 0; j < 40; ++j) {
        const double way = j % 2 == 0 ? 1.0 : -1.0;
        scene.add(10, [=](double time) {
            const double swing = 0.2 * std::sin(3.0 * time + j);
            return Vec3d(way * 20.0 * time + swing, j, 0.0);
        });
    }
    const std::vector<uint32_t> group = scene.groups();
    for (size_t v = 0; v < group.size(); ++v) EXPECT_EQ(group[v], 1 + v / 10 % 2) << v;
}

// Beyond the largest, pieces are not looked at.
TEST(MotionGroups, AreBoundedInNumber) {
    Scene scene;
    for (int j = 0; j < 300; ++j) {
        scene.add(j < 256 ? 4 : 3,
                  [=](double time) { return Vec3d(10.0 * j * time * Vec3d::UnitX()); });
    }
    const std::vector<uint32_t> group = scene.groups();
    EXPECT_EQ(group[4 * 255], 256u);
    EXPECT_EQ(group[4 * 256], 0u);
    EXPECT_EQ(group.back(), 0u);
}

}  // namespace
}  // namespace paim
