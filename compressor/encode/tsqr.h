// The triangular factor of a tall matrix, by blocks: R with RᵀR = A'ᵀA' for the mean-centred A', without
// ever forming that product, which would square the condition number.
// Based on: Demmel, Grigori, Hoemmen and Langou, Communication-Optimal Parallel and Sequential QR and LU
//           Factorizations, 2012 (TSQR)
#pragma once

#include <Eigen/Core>

#include "compressor/encode/row_source.h"

namespace paim {

// Rows are centred by their own mean over the columns, in double. returns [n][n], upper triangular.
// The blocks and the tree that combines them depend on the matrix's size alone, so the bytes are the
// same on any number of threads.
Eigen::MatrixXd centred_triangular_factor(const RowSource& rows);

// Rows that are read together for n columns: many, as each column may be a file to open.
uint64_t rows_per_block(uint32_t num_columns);

// Rows that are worked on together: few, so that their doubles stay in the cache.
constexpr Eigen::Index kRowsAtOnce = 256;

// Subtracts from each row of the block its mean over the columns; mean [rows].
void centre_rows(const Eigen::Ref<const Eigen::MatrixXf>& block, Eigen::MatrixXd& centred,
                 Eigen::VectorXd& mean);

}  // namespace paim
