// How many components the motion of every single vertex needs.
#include "compressor/encode/svd/vertex_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "paim/base/seed.h"
#include "paim/base/vector.h"

namespace paim {
namespace {

constexpr Eigen::Index kTracks = 900, kTimes = 16;

// Vertices in columns of three planes: a body that walks along x and sways along z, the last three
// vertices of which are a hand that swings along y.
Eigen::MatrixXf walk(double walked, double swayed, double swung) {
    Eigen::MatrixXf rows(3 * kTracks, kTimes);
    for (Eigen::Index v = 0; v < kTracks; ++v) {
        for (Eigen::Index p = 0; p < kTimes; ++p) {
            const double time = 2.0 * kPi * static_cast<double>(p) / kTimes;
            const double height = static_cast<double>(v) / kTracks;
            const double y = height + (v >= kTracks - 3 ? swung * std::sin(3.0 * time) : 0.0);
            rows(v, p) = static_cast<float>(std::sin(17.0 * height) + walked * std::cos(time));
            rows(kTracks + v, p) = static_cast<float>(y);
            rows(2 * kTracks + v, p) =
                static_cast<float>(std::cos(9.0 * height) * (1.0 + swayed * std::cos(2.0 * time)));
        }
    }
    return rows;
}

uint32_t needed(const Eigen::MatrixXf& matrix, const MotionLimits& limits, bool with_hand = true) {
    const MatrixRows rows(matrix);
    std::vector<uint32_t> vertices(with_hand ? kTracks : kTracks - 3);
    std::iota(vertices.begin(), vertices.end(), 0u);
    return components_for_motion(rows, principal_components(rows), vertices, limits);
}

TEST(VertexMotion, NeedsAComponentThatFewVerticesHave) {
    // Three components of very different energy: walking, swaying, the hand.
    const Eigen::MatrixXf matrix = walk(30.0, 0.3, 0.3);
    EXPECT_EQ(needed(matrix, {0.1, 1e-3}), 3u);
    EXPECT_EQ(needed(matrix, {0.1, 1e-3}, false), 2u);
}

// A floor that stands still, under a body that walks, moves the mean of all of them.
TEST(VertexMotion, IsJudgedWithinGroups) {
    Eigen::MatrixXf matrix = walk(30.0, 0.0, 0.3);
    constexpr Eigen::Index kFloor = 300;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (Eigen::Index v = 0; v < kFloor; ++v) {
            matrix.row(axis * kTracks + v).setConstant(matrix(axis * kTracks + v, 0));
        }
    }
    MotionLimits limits{0.1, 1e-3};
    EXPECT_EQ(needed(matrix, limits), 1u);
    limits.group.assign(kTracks, 0);
    std::fill_n(limits.group.begin(), kFloor, 1u);
    EXPECT_EQ(needed(matrix, limits), 2u);
}

// One vertex flies far away, in too many poses to be an outlier.
TEST(VertexMotion, IsNotHiddenByOneVertex) {
    Eigen::MatrixXf matrix = walk(0.0, 0.0, 0.3);
    for (Eigen::Index p = 0; p < kTimes; ++p) matrix(5, p) = p % 3 == 0 ? 5000.0f : 0.0f;
    EXPECT_EQ(needed(matrix, {0.1, 1e-3}), 2u);
}

TEST(VertexMotion, MayLoseWhatCannotBeSeen) {
    const Eigen::MatrixXf matrix = walk(30.0, 0.3, 0.3);
    // The RMS of a sine is its amplitude by √2. The hand sways by 0.3 |cos 9h|, and so do others by
    // up to 0.3. All walk a hundred times farther.
    const double swing = 0.3 / std::sqrt(2.0);
    EXPECT_EQ(needed(matrix, {0.0, 0.98 * swing}), 3u);
    EXPECT_EQ(needed(matrix, {0.0, 1.02 * swing}), 2u);
    EXPECT_EQ(needed(matrix, {0.0, 1.02 * swing * std::hypot(1.0, std::cos(9.0))}), 1u);
    EXPECT_EQ(needed(matrix, {0.0, 40.0}), 0u);
}

TEST(VertexMotion, IsJudgedWithinTheMesh) {
    // The hand swings by 0.3 and sways by |cos 9h| 0.5, in the mesh and with it. Walking is no reason
    // to lose either, but a large share that may be lost is.
    const Eigen::MatrixXf matrix = walk(30.0, 0.5, 0.3);
    const double sway = 0.5 * std::abs(std::cos(9.0));
    const double share = 0.3 / std::hypot(0.3, sway);  // of the hand, about
    EXPECT_EQ(needed(matrix, {0.9 * share, 1e-3}), 3u);
    EXPECT_LT(needed(matrix, {1.1 * share, 1e-3}), 3u);
    // What moves with all others is needed to what can be seen.
    EXPECT_EQ(needed(walk(1.0, 0.0, 0.0), {0.1, 0.01}), 1u);
    EXPECT_EQ(needed(walk(0.0, 0.0, 0.0), {0.1, 0.01}), 0u);
}

// By the definition, vertex by vertex.
TEST(VertexMotion, IsThatOfDecodedPoses) {
    RandomStream random(3);
    constexpr Eigen::Index kPoints = 40;
    Eigen::MatrixXf matrix(3 * kPoints, kTimes);
    for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
        const double size = std::pow(10.0, -3.0 * random.uniform());
        for (Eigen::Index p = 0; p < kTimes; ++p) {
            matrix(r, p) = static_cast<float>(size * random.uniform());
        }
    }
    const MatrixRows rows(matrix);
    const PrincipalComponents components = principal_components(rows);
    std::vector<uint32_t> vertices(kPoints);
    std::iota(vertices.begin(), vertices.end(), 0u);
    const Eigen::MatrixXd exact = matrix.cast<double>();
    const Eigen::MatrixXd centred = exact.colwise() - exact.rowwise().mean();
    const auto is_within = [&](uint32_t k, const MotionLimits& limits) {
        const Eigen::MatrixXd v = components.v.leftCols(k);
        const Eigen::MatrixXd lost = centred - centred * v * v.transpose();
        for (Eigen::Index point = 0; point < kPoints; ++point) {
            double dropped = 0.0, motion = 0.0;
            for (Eigen::Index axis = 0; axis < 3; ++axis) {
                const Eigen::Index row = axis * kPoints + point;
                const auto plane = centred.middleRows(axis * kPoints, kPoints);
                dropped += lost.row(row).squaredNorm();
                motion += (centred.row(row) - plane.colwise().mean()).squaredNorm();
            }
            const double rms = std::sqrt(dropped / kTimes);
            if (rms > limits.lost_share * std::sqrt(motion / kTimes) && rms > limits.invisible) {
                return false;
            }
        }
        return true;
    };
    for (const MotionLimits& limits :
         {MotionLimits{0.1, 0.0}, {0.5, 0.0}, {0.1, 0.05}, {0.0, 0.1}, {0.9, 0.3}}) {
        const uint32_t k = components_for_motion(rows, components, vertices, limits);
        EXPECT_TRUE(is_within(k, limits)) << k;
        EXPECT_TRUE(k == 0 || !is_within(k - 1, limits)) << k;
    }
}

}  // namespace
}  // namespace paim
