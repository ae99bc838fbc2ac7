// Which sequences over the poses a decoder can make.
#include "paim/metrics/pose_space.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "paim/base/error.h"
#include "tests/unit/metrics/random_planes.h"

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

MatrixXd space_of(const MatrixXf& columns) {
    return orthonormal_pose_space({columns.data(), static_cast<size_t>(columns.size())},
                                  static_cast<uint32_t>(columns.rows()));
}

TEST(PoseSpace, OfNoComponentsIsTheMean) {
    const MatrixXd space = orthonormal_pose_space({}, 4);
    ASSERT_EQ(space.cols(), 1);
    for (Index p = 0; p < 4; ++p) EXPECT_EQ(space(p, 0), 0.5);
}

TEST(PoseSpace, IsOrthonormalAndHoldsEveryWeight) {
    MatrixXf weights = gaussian(20, 6, 1).cast<float>();
    weights.col(2) *= 1e-20f;  // however small
    const MatrixXd space = space_of(weights);
    ASSERT_EQ(space.cols(), 7);
    const MatrixXd identity = MatrixXd::Identity(7, 7);
    EXPECT_LT((space.transpose() * space - identity).cwiseAbs().maxCoeff(), 1e-14);
    for (Index k = 0; k < 6; ++k) {
        const Eigen::VectorXd w = weights.col(k).cast<double>();
        EXPECT_LT((w - space * (space.transpose() * w)).norm(), 1e-14 * w.norm()) << k;
    }
}

// Directions of orthogonal weights are kept, so that what passes is measured along components.
TEST(PoseSpace, KeepsTheDirectionsOfOrthogonalWeights) {
    MatrixXd all(16, 5);
    all << Eigen::VectorXd::Ones(16), gaussian(16, 4, 2);
    const MatrixXd orthogonal =
        MatrixXd(all.householderQr().householderQ() * MatrixXd::Identity(16, 5)).rightCols(4);
    const MatrixXd space = space_of((7.0 * orthogonal).cast<float>());
    // The floats' rounding, 2^-24 of each.
    for (Index k = 0; k < 4; ++k) {
        EXPECT_NEAR(std::abs(space.col(k + 1).dot(orthogonal.col(k))), 1.0, 1e-6) << k;
    }
}

TEST(PoseSpace, LeavesOutWhatIsNotNew) {
    MatrixXf weights = gaussian(9, 5, 3).cast<float>();
    weights.col(1) = 2.0f * weights.col(0);
    weights.col(2).setConstant(3.0f);
    weights.col(3).setZero();
    EXPECT_EQ(space_of(weights).cols(), 3);  // the mean, 0 and 4
    EXPECT_EQ(space_of(gaussian(3, 8, 4).cast<float>()).cols(), 3) << "no more than poses";
    EXPECT_EQ(space_of(MatrixXf::Ones(1, 2)).cols(), 1);
}

TEST(PoseSpace, RefusesWeightsThatAreNoNumbers) {
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        try {
            orthonormal_pose_space(std::vector<float>{1, 2, 3, 4, bad, 6}, 3);
            FAIL() << bad;
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            EXPECT_STREQ(error.what(), "weights of component 1: not a finite number");
        }
    }
}

}  // namespace
}  // namespace paim
