// The largest eigenvalues of a Gram matrix, with their eigenvectors.
// Based on: Rutishauser, Simultaneous Iteration Method for Symmetric Matrices, 1970; Halko,
//           Martinsson and Tropp 2011 (more directions than are wanted)
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace paim {

struct Eigenpairs {
    Eigen::VectorXd values;   // [m] descending
    Eigen::MatrixXd vectors;  // [n][m] orthonormal columns
};

// All eigenpairs of a symmetric matrix [n][n]. A matrix without rows has none: Eigen's solver would
// read its first value.
Eigenpairs all_eigenpairs(const Eigen::MatrixXd& symmetric);

// Directions that are iterated for so many that are wanted of n.
Eigen::Index iterated_directions(Eigen::Index wanted, Eigen::Index n);

// Whether top_eigenpairs() iterates; else it needs no start.
bool is_iterated(Eigen::Index wanted, Eigen::Index n);

// The best of the span of orthonormal columns Q (Rayleigh and Ritz), given G Q.
// Values are at least 0.
Eigenpairs ritz_pairs(const Eigen::MatrixXd& q, const Eigen::MatrixXd& gram_q, Eigen::Index wanted);

// An orthonormal basis of the span of columns, as many of them.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& columns);

// gram   [n][n] symmetric, positive semidefinite, both halves filled
// start  [n][iterated_directions()] orthonormal columns, the nearer to the eigenvectors the better;
//        anything where is_iterated() is false
// Small matrices are decomposed whole. Others are iterated until a step gains less than 10^-4 of
// what the wanted values leave of the trace, or 2^-40 of all. What is found is orthonormal and its
// values are exact for it (v · G v), so that energies add up, converged or not. Values are at least
// 0.
Eigenpairs top_eigenpairs(const Eigen::MatrixXd& gram, Eigen::Index wanted, Eigen::MatrixXd start);

// Memory of top_eigenpairs() in addition to the matrix: of a small one its decomposition, of others
// the iterated directions and their products.
uint64_t top_eigenpairs_scratch_bytes(uint64_t n, uint64_t wanted);

}  // namespace paim
