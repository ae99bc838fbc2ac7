// One-sided Jacobi: identities, graded spectra, degenerate matrices, and Eigen's as the slow
// reference.
#include "compressor/encode/svd/jacobi_svd.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

#include "tests/reference_svd.h"

namespace paim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd random_orthogonal(int n, unsigned seed) {
    std::srand(seed);
    const MatrixXd random = MatrixXd::Random(n, n);
    return Eigen::HouseholderQR<MatrixXd>(random).householderQ();
}

void expect_svd_of(const MatrixXd& matrix, const SmallSvd& svd) {
    const auto m = matrix.rows();
    ASSERT_EQ(svd.v.rows(), matrix.cols());
    const double largest = m > 0 ? svd.singular_values[0] : 0.0;
    // The columns of A·V are orthogonal with the singular values as lengths; columns of V that
    // belong to rounding are not held to it.
    const MatrixXd product = matrix * svd.v;
    for (Eigen::Index k = 0; k < m; ++k) {
        EXPECT_NEAR(product.col(k).stableNorm(), svd.singular_values[k], 1e-13 * largest);
        EXPECT_LE(svd.singular_values[k], svd.singular_values[std::max<Eigen::Index>(k, 1) - 1]);
        if (svd.singular_values[k] <= 1e-14 * largest) continue;
        EXPECT_NEAR(svd.v.col(k).norm(), 1.0, 1e-14);
        for (Eigen::Index j = 0; j < k; ++j) {
            EXPECT_NEAR(svd.v.col(j).dot(svd.v.col(k)), 0.0, 1e-13) << j << ' ' << k;
        }
    }
}

TEST(JacobiSvd, AgreesWithEigenOnRandomMatrices) {
    for (const int n : {1, 2, 5, 40}) {
        std::srand(static_cast<unsigned>(n));
        const MatrixXd matrix = MatrixXd::Random(n, n);
        const SmallSvd svd = jacobi_svd(matrix);
        expect_svd_of(matrix, svd);
        const VectorXd reference = reference_svd(matrix).singular_values;
        EXPECT_LT((svd.singular_values - reference).norm(), 1e-13 * reference[0] * n);
    }
}

// Of the two unit vectors of a singular value, the answer is the one whose largest entry is
// positive, so that neither the signs of rows nor those of the whole matrix change it.
TEST(JacobiSvd, ChoosesTheSignsOfVectors) {
    std::srand(6);
    const MatrixXd matrix = MatrixXd::Random(12, 30);
    const SmallSvd svd = jacobi_svd(matrix);
    for (Eigen::Index k = 0; k < 12; ++k) {
        Eigen::Index largest = 0;
        svd.v.col(k).cwiseAbs().maxCoeff(&largest);
        EXPECT_GT(svd.v(largest, k), 0.0) << k;
    }
    MatrixXd turned = -matrix;
    turned.row(3) *= -1.0;
    turned.row(8) *= -1.0;
    // Vectors are off by 2^-52 times the largest value over the gap to the next, here below 1000.
    EXPECT_LT((jacobi_svd(turned).v - svd.v).cwiseAbs().maxCoeff(), 1e-12);
    // So are the vectors of numbers that are known: largest entries of either sign.
    MatrixXd known(2, 3);
    known << 3, -4, 0, 0, 0, -2;
    const SmallSvd of_known = jacobi_svd(known);
    EXPECT_LT((of_known.v.col(0) - Eigen::Vector3d(-0.6, 0.8, 0)).norm(), 1e-15);
    EXPECT_LT((of_known.v.col(1) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-15);
}

TEST(JacobiSvd, KeepsTinyValuesOfGradedMatrices) {
    // Columns of length 10^-k: their relative accuracy survives, which a Gram matrix loses below
    // 1e-8.
    constexpr int kSize = 15;
    const MatrixXd u = random_orthogonal(kSize, 4);
    MatrixXd matrix = u;
    for (int k = 0; k < kSize; ++k) matrix.col(k) *= std::pow(10.0, -k);
    const SmallSvd svd = jacobi_svd(matrix);
    for (int k = 0; k < kSize; ++k) {
        EXPECT_NEAR(svd.singular_values[k] * std::pow(10.0, k), 1.0, 1e-12) << k;
    }
}

TEST(JacobiSvd, TakesMoreColumnsThanRows) {
    std::srand(8);
    const MatrixXd matrix = MatrixXd::Random(6, 50);
    const SmallSvd svd = jacobi_svd(matrix);
    expect_svd_of(matrix, svd);
    const VectorXd reference = reference_svd(matrix).singular_values;
    EXPECT_LT((svd.singular_values - reference).norm(), 1e-13 * reference[0]);
}

TEST(JacobiSvd, ComesToRestOnRepeatedColumns) {
    // Rank 20 of 120: the rest is rounding, which must not be turned for ever.
    std::srand(9);
    const MatrixXd matrix = MatrixXd::Random(120, 20) * MatrixXd::Random(20, 120);
    const SmallSvd svd = jacobi_svd(matrix);
    expect_svd_of(matrix, svd);
    EXPECT_LT(svd.singular_values[20], 1e-13 * svd.singular_values[0]);
    EXPECT_GT(svd.singular_values[19], 1e-3 * svd.singular_values[0]);
}

TEST(JacobiSvd, TakesZeroRankOneAndExtremeMatrices) {
    const SmallSvd zero = jacobi_svd(MatrixXd::Zero(4, 4));
    EXPECT_EQ(zero.singular_values.norm(), 0.0);
    expect_svd_of(MatrixXd::Zero(4, 4), zero);
    const MatrixXd one = VectorXd::Ones(6) * VectorXd::LinSpaced(6, 1.0, 2.0).transpose();
    const SmallSvd rank_one = jacobi_svd(one);
    expect_svd_of(one, rank_one);
    EXPECT_LT(rank_one.singular_values[1], 1e-15 * rank_one.singular_values[0]);
    for (const double scale : {1e-200, 1e200}) {
        const SmallSvd extreme = jacobi_svd(scale * one);
        EXPECT_NEAR(extreme.singular_values[0] / scale / rank_one.singular_values[0], 1.0, 1e-14);
    }
    EXPECT_EQ(jacobi_svd(MatrixXd(0, 0)).singular_values.size(), 0);
}

TEST(JacobiSvdDeathTest, RefusesNumbersThatAreNone) {
    MatrixXd matrix = MatrixXd::Identity(2, 2);
    matrix(0, 1) = std::nan("");
    EXPECT_DEATH(jacobi_svd(matrix), "check failed");
}

}  // namespace
}  // namespace paim
