// The triangular factor of a tall matrix, by blocks: R with RᵀR = A'ᵀA' for the mean-centred A',
// without ever forming that product, which would square the condition number.
// Based on: Demmel, Grigori, Hoemmen and Langou, Communication-Optimal Parallel and Sequential QR
//           and LU Factorizations, 2012 (TSQR)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>

#include "compressor/encode/data/row_source.h"

namespace paim {

// Runs of blocks that are factored side by side, and blocks that wait to be written in order. Each
// run holds an n x n factor; fewer in flight need less memory and give the same bytes.
constexpr uint32_t kMaxInFlight = 32;

// What is factored, [rows][n], of centred rows [rows][P].
using RowMap = std::function<void(const Eigen::MatrixXd& centred, Eigen::MatrixXd& mapped)>;

// Rows are centred by their own mean over the columns, in double, and mapped where there is a map
// to num_columns columns. returns [n][n], upper triangular.
// num_in_flight  a power of two to kMaxInFlight
// The blocks and the tree that combines them depend on the matrix's size alone, so the bytes are
// the same on any number of threads and with any number in flight.
Eigen::MatrixXd triangular_factor(const RowSource& rows, Eigen::Index num_columns,
                                  const RowMap& map, uint32_t num_in_flight = kMaxInFlight);
Eigen::MatrixXd centred_triangular_factor(const RowSource& rows,
                                          uint32_t num_in_flight = kMaxInFlight);

// Memory of the rows that are at work while a data matrix of num_columns columns is read: on each
// of min(num_threads, num_blocks) threads a block as it is read, and kRowsAtOnce of its rows in
// double, centred and mapped to num_mapped columns, each with as much again for products.
uint64_t rows_at_work_bytes(uint64_t num_columns, uint64_t num_mapped, uint64_t num_threads,
                            uint64_t num_blocks);

// Memory of triangular_factor() in addition to the rows at work: the [n][n] factors in flight and
// those that wait for their neighbours in the tree.
uint64_t triangular_factor_bytes(uint64_t num_columns, uint32_t num_in_flight);

// Rows that are read together for n columns: many, as each column may be a file to open.
uint64_t rows_per_block(uint32_t num_columns);

// Rows that are worked on together: few, so that their doubles stay in the cache.
constexpr Eigen::Index kRowsAtOnce = 256;

// Subtracts from each row of the block its mean over the columns; mean [rows].
void centre_rows(const Eigen::Ref<const Eigen::MatrixXf>& block, Eigen::MatrixXd& centred,
                 Eigen::VectorXd& mean);

}  // namespace paim
