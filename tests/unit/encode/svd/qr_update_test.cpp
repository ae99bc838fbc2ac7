// Folding rows into a triangular factor: its defining identity, Eigen's QR as reference, odd
// shapes.
#include "compressor/encode/svd/qr_update.h"

#include <gtest/gtest.h>

#include <Eigen/QR>

#include <cmath>

namespace paim {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

TEST(FoldRows, AgreesWithEigenOnTheStackedMatrix) {
    // Panels of 16 columns: none, one, several, full and not.
    for (const Index n : {1, 2, 15, 16, 17, 50}) {
        std::srand(static_cast<unsigned>(n));
        const MatrixXd all = MatrixXd::Random(3 * n + 7, n);
        MatrixXd r = MatrixXd::Zero(n, n);
        for (Index row = 0; row < all.rows(); row += n + 3) {
            MatrixXd some = all.middleRows(row, std::min(n + 3, all.rows() - row));
            fold_rows(r, some);
        }
        const Eigen::HouseholderQR<MatrixXd> qr(all);
        const MatrixXd reference =
            qr.matrixQR().topRows(n).triangularView<Eigen::Upper>().toDenseMatrix();
        // Rows are unique up to sign; random matrices of 3 n rows have condition below 10, so that
        // n roundings of 2^-53 relative stay below this.
        EXPECT_LT((r.cwiseAbs() - reference.cwiseAbs()).norm(), 1e-14 * n * reference.norm()) << n;
        EXPECT_EQ(r.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 0.0);
    }
}

TEST(FoldRows, KeepsSmallColumnsThatAGramMatrixLoses) {
    // The columns differ by 1e-10 of their length: squared that is below rounding.
    constexpr double kSmall = 1e-10;
    MatrixXd rows = MatrixXd::Zero(3, 2);
    rows << 1, 1, kSmall, 0, 0, kSmall;
    MatrixXd r = MatrixXd::Zero(2, 2);
    fold_rows(r, rows);
    // R(1,1)² = |b|² − (a·b)²/|a|² = 2 kSmall² to first order.
    EXPECT_NEAR(std::abs(r(1, 1)) / (std::sqrt(2.0) * kSmall), 1.0, 1e-5);
}

// A reflection maps the diagonal element to the sign that is opposite to its own: to the same one,
// their difference would be a small number of two large ones, of which rounding leaves nothing.
// Rows that are smaller than the factor by 10^-k, for which that difference has lost 2 k digits.
TEST(FoldRows, KeepsRowsThatAreSmallBesideTheFactor) {
    constexpr Index kSize = 20;  // more than a panel
    std::srand(3);
    for (const double small : {1e-3, 1e-6, 1e-9, 1e-12}) {
        const MatrixXd before =
            MatrixXd(MatrixXd::Random(kSize, kSize) + 10.0 * MatrixXd::Identity(kSize, kSize))
                .triangularView<Eigen::Upper>();
        const MatrixXd rows = small * MatrixXd::Random(5, kSize);
        for (const double sign : {1.0, -1.0}) {
            MatrixXd r = sign * before, folded = rows;
            fold_rows(r, folded);
            ASSERT_TRUE(r.allFinite()) << small;
            // Against the stacked matrix, whose Gram matrix has entries of about 100 and rounds
            // them by 2^-53 a few times; R by as much, over columns of 20 entries.
            const MatrixXd gram = before.transpose() * before + rows.transpose() * rows;
            EXPECT_LT((r.transpose() * r - gram).cwiseAbs().maxCoeff(), 1e-13 * gram.maxCoeff())
                << small;
            // Diagonal elements change their signs; what is below them is what they grow by.
            for (Index j = 0; j < kSize; ++j) {
                EXPECT_LT(r(j, j) * sign, 0.0) << small << ' ' << j;
            }
        }
    }
}

TEST(FoldRows, TakesFewRowsZerosAndNothing) {
    MatrixXd r = MatrixXd::Zero(20, 20);
    MatrixXd none(0, 20), zeros = MatrixXd::Zero(5, 20);
    fold_rows(r, none);
    fold_rows(r, zeros);
    EXPECT_EQ(r, MatrixXd::Zero(20, 20));
    std::srand(2);
    MatrixXd few = MatrixXd::Random(3, 20);
    few.col(4).setZero();
    const MatrixXd gram = few.transpose() * few;
    fold_rows(r, few);
    EXPECT_LT((r.transpose() * r - gram).norm(), 1e-14 * gram.norm());
    MatrixXd empty(0, 0), no_columns(4, 0);
    fold_rows(empty, no_columns);
}

TEST(FoldRowsDeathTest, RefusesOtherShapes) {
    MatrixXd r = MatrixXd::Zero(3, 3), rows = MatrixXd::Zero(5, 4);
    EXPECT_DEATH(fold_rows(r, rows), "check failed");
}

}  // namespace
}  // namespace paim
