// Axes of vertices and points that a codec's groups have.
#include "paim/metrics/group_axes.h"

#include <gtest/gtest.h>

#include "tests/unit/metrics/random_planes.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

constexpr uint32_t kGroups = 5, kPoints = 4;
constexpr Index kDirections = 6;
constexpr int kPlanes = 2;
// Of floats that are sums of a few products of about 1.
constexpr float kRounding = 1e-5f;

// 40 vertices, in groups that alternate. Group 2 has two vertices, half as many as points, group 3 one,
// and group 4 none.
PointGroups some_groups() {
    PointGroups groups{kGroups, {}, gaussian(40, kPoints, 1).cast<float>(), true};
    for (uint32_t v = 0; v < 40; ++v)
        groups.group.push_back(v == 7 || v == 20 ? 2 : v == 30 ? 3 : v % 2);
    groups.factors.col(0).setConstant(0.5f);
    return groups;
}

MatrixXf points_of(int plane) {
    MatrixXf points =
        gaussian(kDirections, Index{kGroups} * kPoints, 10 + static_cast<uint64_t>(plane))
            .cast<float>();
    // In group 1, of the points but the first, and in this plane alone.
    if (plane == 0) points.col(6) = 2.0f * points.col(5);
    return points;
}

double weight_of(int plane) {
    return plane == 0 ? 1.0 : 0.25;
}

GroupAxes make_axes(const PointGroups& groups) {
    GroupAxes axes(groups);
    for (int plane = 0; plane < kPlanes; ++plane) {
        axes.add_points(points_of(plane), weight_of(plane));
    }
    axes.orthonormalise_points();
    return axes;
}

TEST(GroupAxes, OfVerticesAreOrthonormalAndSpanTheFactors) {
    const PointGroups groups = some_groups();
    const GroupAxes axes = make_axes(groups);
    for (uint32_t g = 0; g < kGroups; ++g) {
        const MatrixXf of_vertices = axes.vertex_axes(g);
        const auto members = axes.members(g);
        ASSERT_EQ(of_vertices.cols(), static_cast<Index>(members.size()));
        const Index rank = g < 2 ? kPoints : static_cast<Index>(members.size());
        const MatrixXf gram = of_vertices * of_vertices.transpose();
        MatrixXf expected = MatrixXf::Zero(kPoints, kPoints);
        expected.topLeftCorner(rank, rank).setIdentity();
        EXPECT_LT((gram - expected).cwiseAbs().maxCoeff(), kRounding) << g;
        const MatrixXf factors = groups.factors(members, Eigen::all).transpose();
        const MatrixXf along = factors * of_vertices.transpose() * of_vertices;
        EXPECT_LT((along - factors).norm(), 10.0f * kRounding) << g;
    }
}

TEST(GroupAxes, OfPointsAreOrthonormalOverAllPlanesWithTheirWeights) {
    const GroupAxes axes = make_axes(some_groups());
    ASSERT_EQ(axes.num_point_axes(), Index{kPoints} - 1);
    EXPECT_FALSE(axes.has_point_axes(3));
    EXPECT_FALSE(axes.has_point_axes(4));
    for (uint32_t g = 0; g < 3; ++g) {
        MatrixXd gram = MatrixXd::Zero(kPoints - 1, kPoints - 1);
        for (int plane = 0; plane < kPlanes; ++plane) {
            const MatrixXd of_plane = axes.point_axes(g, points_of(plane)).cast<double>();
            gram += weight_of(plane) * of_plane.transpose() * of_plane;
        }
        EXPECT_LT((gram - MatrixXd::Identity(kPoints - 1, kPoints - 1)).cwiseAbs().maxCoeff(),
                  double{kRounding})
            << g;
    }
}

TEST(GroupAxes, AreZeroForPointsThatDependOnThoseBefore) {
    GroupAxes axes(some_groups());
    axes.add_points(points_of(0), 1.0);
    axes.orthonormalise_points();
    EXPECT_TRUE(axes.point_axes(1, points_of(0)).col(1).isZero());
    EXPECT_NEAR(axes.point_axes(1, points_of(0)).col(2).norm(), 1.0f, kRounding);
}

TEST(GroupAxes, GiveTheCoordinatesOfDecodedVertices) {
    const PointGroups groups = some_groups();
    const GroupAxes axes = make_axes(groups);
    for (uint32_t g = 0; g < 3; ++g) {
        const auto members = axes.members(g);
        const MatrixXf factors = groups.factors(members, Eigen::all).transpose();  // [R][V_g]
        MatrixXf expected = MatrixXf::Zero(kPoints - 1, factors.cols());
        for (int plane = 0; plane < kPlanes; ++plane) {
            const MatrixXf points = points_of(plane);
            const MatrixXf decoded = points.middleCols(Index{g} * kPoints, kPoints) * factors;
            expected += static_cast<float>(weight_of(plane)) *
                        axes.point_axes(g, points).transpose() * decoded;
        }
        const MatrixXf got = axes.decoded_coordinates(g);
        EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 10.0f * kRounding) << g;
    }
}

TEST(GroupAxes, OfGroupsThatAreNotAffineHaveAllPoints) {
    PointGroups groups = some_groups();
    groups.is_affine = false;
    EXPECT_EQ(make_axes(groups).num_point_axes(), Index{kPoints});
}

}  // namespace
}  // namespace paim
