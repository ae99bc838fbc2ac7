// One-sided Jacobi: singular values and right singular vectors of a small matrix to high relative
// accuracy.
// Based on: Hestenes, Inversion of Matrices by Biorthogonalization and Related Results, 1958; de
//           Rijk, A One-Sided Jacobi Algorithm for Computing the Singular Value Decomposition on a
//           Vector Computer, 1989; Demmel and Veselić, Jacobi's Method Is More Accurate than QR,
//           1992
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace paim {

struct SmallSvd {
    Eigen::VectorXd singular_values;  // [m] descending
    Eigen::MatrixXd v;  // [n][m] orthonormal columns, one a singular value; zero where that is zero
};

// matrix  [m][n], m <= n, finite (checked)
// The signs of v's columns are chosen so that the entry of largest magnitude is positive, so that
// the answer is unique where singular values differ. O(n m²) a sweep.
SmallSvd jacobi_svd(const Eigen::MatrixXd& matrix);

// Memory of jacobi_svd() for n columns: the matrix, its rows, their rotations and V.
constexpr uint64_t jacobi_svd_bytes(uint64_t num_columns) {
    return 4 * num_columns * num_columns * sizeof(double);
}

}  // namespace paim
