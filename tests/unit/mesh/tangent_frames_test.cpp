// Frames of vertices against what they are for: they go with the surface.
#include "paim/mesh/tangent_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "paim/mesh/normals.h"
#include "poses/octopus.h"

namespace paim {
namespace {

using Frames = std::vector<Eigen::Matrix3f>;

Frames frames_of(const Topology& topology, const std::vector<Vec3f>& reference,
                 const std::vector<Vec3f>& positions) {
    return TangentFrames(topology, reference).at(positions);
}

std::vector<Vec3f> turned(const std::vector<Vec3f>& points, const Eigen::Matrix3f& rotation) {
    std::vector<Vec3f> result;
    for (const Vec3f& point : points) result.push_back(rotation * point + Vec3f(3, -2, 1));
    return result;
}

// A bumpy square of (n + 1)² vertices.
struct Patch {
    Topology topology;
    std::vector<Vec3f> positions;
};

Patch make_patch(uint32_t n) {
    Patch patch;
    patch.topology.num_vertices = (n + 1) * (n + 1);
    for (uint32_t j = 0; j <= n; ++j) {
        for (uint32_t i = 0; i <= n; ++i) {
            const auto x = static_cast<float>(i) / static_cast<float>(n);
            const auto y = static_cast<float>(j) / static_cast<float>(n);
            patch.positions.emplace_back(x, y, 0.1f * std::sin(4.0f * x) * std::cos(3.0f * y));
            if (i == n || j == n) continue;
            const uint32_t v = j * (n + 1) + i;
            patch.topology.triangles.push_back({v, v + 1, v + n + 2});
            patch.topology.triangles.push_back({v, v + n + 2, v + n + 1});
        }
    }
    return patch;
}

TEST(TangentFrames, AreRotationsAlongTheNormals) {
    const PoseSet octopus = poses::make_octopus(1000, 4);
    const std::vector<Vec3f> first = octopus.load_pose(0).positions;
    for (uint32_t p = 0; p < 4; ++p) {
        const Pose pose = octopus.load_pose(p);
        const std::vector<Vec3f> normals = vertex_normals(octopus.topology(), pose.positions);
        const Frames frames = TangentFrames(octopus.topology(), first).at(pose.positions);
        for (size_t v = 0; v < frames.size(); ++v) {
            EXPECT_LT((frames[v].col(2) - normals[v]).norm(), 1e-6f);
            EXPECT_LT((frames[v].transpose() * frames[v] - Eigen::Matrix3f::Identity()).norm(),
                      1e-6f);
            EXPECT_NEAR(frames[v].determinant(), 1.0f, 1e-6f);
        }
    }
}

const Vec3f kGuide(0.8f, 0.36f, 0.48f);

// In the reference pose the x axis is one direction for all, as near as the surface allows.
TEST(TangentFrames, AreAlikeInTheReferencePose) {
    const Patch patch = make_patch(8);
    const Frames frames = frames_of(patch.topology, patch.positions, patch.positions);
    for (const Eigen::Matrix3f& frame : frames) {
        const Vec3f normal = frame.col(2);
        const Vec3f expected = (kGuide - kGuide.dot(normal) * normal).normalized();
        EXPECT_LT((frame.col(0) - expected).norm(), 1e-5f);
    }
}

TEST(TangentFrames, TurnWithTheBody) {
    const PoseSet octopus = poses::make_octopus(1000, 1);
    const std::vector<Vec3f> first = octopus.load_pose(0).positions;
    const Eigen::Matrix3f rotation =
        Eigen::AngleAxisf(2.0f, Vec3f(1, -2, 0.5f).normalized()).toRotationMatrix();
    const Frames before = frames_of(octopus.topology(), first, first);
    const Frames after = frames_of(octopus.topology(), first, turned(first, rotation));
    for (size_t v = 0; v < before.size(); ++v) {
        // Edges of a hundredth of the body, rounded at its distance from the origin, some 1e-4 of them.
        EXPECT_LT((after[v] - rotation * before[v]).norm(), 5e-3f) << v;
    }
}

// A plane that is stretched and sheared takes its tangents along.
TEST(TangentFrames, FollowAnAffineMap) {
    Patch patch = make_patch(6);
    for (Vec3f& position : patch.positions) position.z() = 0.0f;
    const Eigen::Matrix3f shear{{1.5f, 0.4f, 0}, {0.7f, 0.8f, 0}, {0, 0, 1}};
    std::vector<Vec3f> moved;
    for (const Vec3f& position : patch.positions) moved.push_back(shear * position);
    const Vec3f expected = (shear * Vec3f(0.8f, 0.36f, 0.0f)).normalized();
    for (const Eigen::Matrix3f& frame : frames_of(patch.topology, patch.positions, moved)) {
        EXPECT_LT((frame.col(0) - expected).norm(), 1e-5f);
    }
}

// Files have faces in another order than bakes.
TEST(TangentFrames, DoNotDependOnTheOrderOfFaces) {
    const PoseSet octopus = poses::make_octopus(1000, 2);
    Topology other = octopus.topology();
    std::reverse(other.triangles.begin(), other.triangles.end());
    for (Triangle& t : other.triangles) t = {t[1], t[2], t[0]};
    const std::vector<Vec3f> first = octopus.load_pose(0).positions;
    const std::vector<Vec3f> second = octopus.load_pose(1).positions;
    const Frames expected = frames_of(octopus.topology(), first, second);
    const Frames got = frames_of(other, first, second);
    for (size_t v = 0; v < got.size(); ++v) {
        EXPECT_LT((got[v] - expected[v]).norm(), 1e-5f) << v;
    }
}

// Normals that lean the same way in the frames of every pose make frames that are turned alike.
TEST(TangentFrames, TurnToOtherNormalsAlike) {
    const PoseSet octopus = poses::make_octopus(1000, 3);
    const TangentFrames tangents(octopus.topology(), octopus.load_pose(0).positions);
    const Vec3f lean = Vec3f(0.3f, -0.2f, 1.0f).normalized();
    std::vector<Eigen::Matrix3f> turns;
    for (uint32_t p = 0; p < 3; ++p) {
        const std::vector<Vec3f> positions = octopus.load_pose(p).positions;
        const Frames frames = tangents.at(positions);
        std::vector<Vec3f> normals;
        for (const Eigen::Matrix3f& frame : frames) normals.push_back(frame * lean);
        const Frames leaning = tangents.at(positions, normals);
        for (size_t v = 0; v < frames.size(); ++v) {
            const Eigen::Matrix3f turn = frames[v].transpose() * leaning[v];
            EXPECT_LT((turn.col(2) - lean).norm(), 1e-6f);
            if (p == 0) turns.push_back(turn);
            EXPECT_LT((turn - turns[v]).norm(), 2e-6f);
        }
    }
}

// Frames are rotations whatever the positions are, as they come from files of strangers.
TEST(TangentFrames, OfDegenerateMeshesAreRotations) {
    const Topology topology{5, {{0, 1, 2}, {0, 2, 1}, {1, 1, 3}}};
    for (const float scale : {0.0f, 1e-38f, 1.0f, 1e38f}) {
        const std::vector<Vec3f> line{
            {0, 0, 0}, {scale, 0, 0}, {2 * scale, 0, 0}, {0, scale, 0}, {scale, scale, scale}};
        std::vector<Vec3f> spread = line;
        spread[2] = Vec3f(0, scale, -scale);
        const std::vector<Vec3f> normals{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}, {0, -1, 0}, {0, 0, -1}};
        for (const auto& reference : {line, spread}) {
            for (const auto& positions : {line, spread}) {
                const Frames frames = TangentFrames(topology, reference).at(positions, normals);
                for (size_t v = 0; v < frames.size(); ++v) {
                    EXPECT_TRUE((frames[v].transpose() * frames[v]).isIdentity(1e-5f)) << v;
                }
                EXPECT_TRUE(frames[2].isIdentity(0.0f));
            }
        }
    }
}

}  // namespace
}  // namespace paim
