// The middle and the size of points, with outliers among them.
#include "paim/mesh/body_size.h"

#include <gtest/gtest.h>

#include <vector>

namespace paim {
namespace {

TEST(BodySize, IsAboutTheDiagonalWhateverOutliersDo) {
    std::vector<Vec3d> points;  // evenly in a box of 2 × 4 × 6 round (10, 0, 0)
    constexpr int kSide = 15;
    for (int i = 0; i < kSide; ++i) {
        for (int j = 0; j < kSide; ++j) {
            for (int k = 0; k < kSide; ++k) {
                const Vec3d share = (Vec3d(i, j, k) / (kSide - 1)).array() - 0.5;
                points.push_back(Vec3d(10, 0, 0) + share.cwiseProduct(Vec3d(2, 4, 6)));
            }
        }
    }
    const double diagonal = Vec3d(2, 4, 6).norm();
    const double size = size_of(points);
    EXPECT_LT((median_point(points) - Vec3d(10, 0, 0)).norm(), 1e-12);
    // Observed: 1.17 times as large.
    EXPECT_NEAR(size, diagonal, 0.25 * diagonal);
    // A hundredth of all points flies away.
    for (size_t v = 0; v < points.size(); v += 100) points[v] *= 1e30;
    // By at most as many places in the order, along each axis less than one step of the points.
    EXPECT_LT((median_point(points) - Vec3d(10, 0, 0)).cwiseAbs().maxCoeff(), 6.0 / (kSide - 1));
    EXPECT_NEAR(size_of(points), size, 0.1 * size);
}

}  // namespace
}  // namespace paim
