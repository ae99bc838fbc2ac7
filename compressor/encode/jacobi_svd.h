// One-sided Jacobi: the singular value decomposition of a small square matrix to high relative accuracy.
// Based on: Hestenes, Inversion of Matrices by Biorthogonalization and Related Results, 1958; de Rijk, A
//           One-Sided Jacobi Algorithm for Computing the Singular Value Decomposition on a Vector
//           Computer, 1989; Demmel and Veselić, Jacobi's Method Is More Accurate than QR, 1992
#pragma once

#include <Eigen/Core>

namespace paim {

struct SmallSvd {
    Eigen::VectorXd singular_values;  // [n] descending
    Eigen::MatrixXd v;                // [n][n] orthogonal; column k belongs to singular value k
};

// matrix [n][n], finite (checked). The signs of v's columns are chosen so that the entry of largest
// magnitude is positive, so that the answer is unique where singular values differ.
SmallSvd jacobi_svd(const Eigen::MatrixXd& matrix);

}  // namespace paim
