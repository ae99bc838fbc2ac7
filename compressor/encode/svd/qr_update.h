// Folds more rows into a triangular factor.
// Based on: Golub and Van Loan, Matrix Computations, 4th edition, 2013, sections 5.2 and 6.5;
//           Schreiber and Van Loan, A Storage-Efficient WY Representation for Products of
//           Householder Transformations, 1989
#pragma once

#include <Eigen/Core>

namespace paim {

// Replaces R by the triangular factor of R stacked on `rows`: RᵀR grows by rowsᵀ·rows, without
// forming either product. As R is triangular, each reflection touches one of its rows and the new
// ones only, which is what Eigen's HouseholderQR of the stacked matrix does not know.
// r     [n][n] upper triangular
// rows  [any][n], overwritten. Squares of the entries must neither overflow nor vanish: those of
//       floats do not.
void fold_rows(Eigen::MatrixXd& r, Eigen::MatrixXd& rows);

}  // namespace paim
