// The triangular factor of a tall matrix, by blocks.
// Based on: Demmel, Grigori, Hoemmen and Langou, Communication-Optimal Parallel and Sequential QR and LU
//           Factorizations, 2012 (TSQR)
#include "compressor/encode/tsqr.h"

#include <Eigen/QR>

#include <algorithm>
#include <vector>

#include "paim/base/parallel.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// The triangular factor of one block, [min(rows, n)][n].
MatrixXd triangular_factor(MatrixXd& block) {
    const Index size = std::min(block.rows(), block.cols());
    const Eigen::HouseholderQR<Eigen::Ref<MatrixXd>> qr(block);
    return block.topRows(size).triangularView<Eigen::Upper>();
}

MatrixXd combine(const MatrixXd& upper, const MatrixXd& lower) {
    MatrixXd stacked(upper.rows() + lower.rows(), upper.cols());
    stacked << upper, lower;
    return triangular_factor(stacked);
}

}  // namespace

uint64_t rows_per_block(uint32_t num_columns) {
    return std::max<uint64_t>(2048, 4 * uint64_t{num_columns});
}

void centre_rows(const Eigen::MatrixXf& block, MatrixXd& centred, Eigen::VectorXd& mean) {
    centred = block.cast<double>();
    mean = centred.rowwise().sum() / static_cast<double>(centred.cols());
    centred.colwise() -= mean;
}

MatrixXd centred_triangular_factor(const RowSource& rows) {
    const auto n = static_cast<Index>(rows.num_columns());
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    const uint64_t num_blocks = (rows.num_rows() + block_rows - 1) / block_rows;
    std::vector<MatrixXd> factors(num_blocks);
    parallel_for(num_blocks, 1, [&](size_t b, size_t) {
        const uint64_t first = b * block_rows;
        Eigen::MatrixXf block(static_cast<Index>(std::min(block_rows, rows.num_rows() - first)), n);
        rows.read(first, block);
        MatrixXd centred;
        Eigen::VectorXd mean;
        centre_rows(block, centred, mean);
        factors[b] = triangular_factor(centred);
    });
    // A binary tree over the blocks in order.
    while (factors.size() > 1) {
        std::vector<MatrixXd> next((factors.size() + 1) / 2);
        parallel_for(next.size(), 1, [&](size_t i, size_t) {
            next[i] = 2 * i + 1 < factors.size() ? combine(factors[2 * i], factors[2 * i + 1])
                                                 : std::move(factors[2 * i]);
        });
        factors = std::move(next);
    }
    MatrixXd r = MatrixXd::Zero(n, n);
    if (!factors.empty()) r.topRows(factors[0].rows()) = factors[0];
    return r;
}

}  // namespace paim
