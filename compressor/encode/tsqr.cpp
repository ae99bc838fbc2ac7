// The triangular factor of a tall matrix, by blocks.
// Based on: Demmel, Grigori, Hoemmen and Langou, Communication-Optimal Parallel and Sequential QR and LU
//           Factorizations, 2012 (TSQR)
#include "compressor/encode/tsqr.h"

#include <algorithm>
#include <vector>

#include "compressor/encode/qr_update.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// Runs of blocks that are factored side by side. Each holds one n x n factor, whatever the number of
// rows; more of them would only cost memory.
constexpr uint64_t kNumRuns = 32;

// The factor of blocks [begin, end), one after the other.
MatrixXd factor_of_run(const RowSource& rows, uint64_t begin, uint64_t end) {
    const auto n = static_cast<Index>(rows.num_columns());
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    MatrixXd factor = MatrixXd::Zero(n, n);
    Eigen::MatrixXf block;
    MatrixXd centred;
    Eigen::VectorXd mean;
    for (uint64_t b = begin; b < end; ++b) {
        const uint64_t first = b * block_rows;
        block.resize(static_cast<Index>(std::min(block_rows, rows.num_rows() - first)), n);
        rows.read(first, block);
        for (Index row = 0; row < block.rows(); row += kRowsAtOnce) {
            const Index count = std::min(kRowsAtOnce, block.rows() - row);
            centre_rows(block.middleRows(row, count), centred, mean);
            fold_rows(factor, centred);
        }
    }
    return factor;
}

}  // namespace

uint64_t rows_per_block(uint32_t num_columns) {
    constexpr uint64_t kValues = 1 << 19;  // 2 MB
    const auto at_once = static_cast<uint64_t>(kRowsAtOnce);
    return std::max(at_once, kValues / std::max(num_columns, 1u) / at_once * at_once);
}

void centre_rows(const Eigen::Ref<const Eigen::MatrixXf>& block, MatrixXd& centred,
                 Eigen::VectorXd& mean) {
    centred.resize(block.rows(), block.cols());
    mean.setZero(block.rows());
    // Column by column, as they lie in memory.
    for (Index p = 0; p < block.cols(); ++p) {
        centred.col(p) = block.col(p).cast<double>();
        mean += centred.col(p);
    }
    mean /= static_cast<double>(block.cols());
    centred.colwise() -= mean;
}

MatrixXd centred_triangular_factor(const RowSource& rows) {
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    const uint64_t num_blocks = (rows.num_rows() + block_rows - 1) / block_rows;
    const uint64_t num_runs = std::min(kNumRuns, num_blocks);
    std::vector<MatrixXd> factors(num_runs);
    parallel_for(num_runs, 1, [&](size_t run, size_t) {
        factors[run] =
            factor_of_run(rows, run * num_blocks / num_runs, (run + 1) * num_blocks / num_runs);
    });
    // A binary tree over the runs in order.
    for (size_t stride = 1; stride < factors.size(); stride *= 2) {
        parallel_for((factors.size() + stride - 1) / (2 * stride), 1, [&](size_t i, size_t) {
            const size_t upper = 2 * i * stride;
            fold_rows(factors[upper], factors[upper + stride]);
        });
    }
    const auto n = static_cast<Index>(rows.num_columns());
    return factors.empty() ? MatrixXd::Zero(n, n) : factors[0];
}

}  // namespace paim
