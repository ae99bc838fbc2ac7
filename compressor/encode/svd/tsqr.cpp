// The triangular factor of a tall matrix, by blocks.
// Based on: Demmel, Grigori, Hoemmen and Langou, Communication-Optimal Parallel and Sequential QR
//           and LU Factorizations, 2012 (TSQR)
#include "compressor/encode/svd/tsqr.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>
#include <vector>

#include "compressor/encode/svd/qr_update.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// The factor of the runs of a complete subtree.
struct Subtree {
    MatrixXd factor;
    uint64_t num_runs;
};

// The factor of blocks [begin, end), one after the other.
MatrixXd factor_of_run(const RowSource& rows, Index n, const RowMap& map, uint64_t begin,
                       uint64_t end) {
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    MatrixXd factor = MatrixXd::Zero(n, n);
    Eigen::MatrixXf block;
    MatrixXd centred, mapped;
    Eigen::VectorXd mean;
    for (uint64_t b = begin; b < end; ++b) {
        const uint64_t first = b * block_rows;
        block.resize(static_cast<Index>(std::min(block_rows, rows.num_rows() - first)),
                     static_cast<Index>(rows.num_columns()));
        rows.read(first, block);
        for (Index row = 0; row < block.rows(); row += kRowsAtOnce) {
            const Index count = std::min(kRowsAtOnce, block.rows() - row);
            centre_rows(block.middleRows(row, count), centred, mean);
            if (map) map(centred, mapped);
            fold_rows(factor, map ? mapped : centred);
        }
    }
    return factor;
}

// factors[0] becomes the factor of all, by a binary tree over them in order.
void combine(std::span<MatrixXd> factors) {
    for (size_t stride = 1; stride < factors.size(); stride *= 2) {
        parallel_for((factors.size() + stride - 1) / (2 * stride), 1, [&](size_t i, size_t) {
            const size_t upper = 2 * i * stride;
            fold_rows(factors[upper], factors[upper + stride]);
            factors[upper + stride].resize(0, 0);
        });
    }
}

}  // namespace

uint64_t rows_per_block(uint32_t num_columns) {
    constexpr uint64_t kValues = 1 << 19;  // 2 MB
    const auto at_once = static_cast<uint64_t>(kRowsAtOnce);
    return std::max(at_once, kValues / std::max(num_columns, 1u) / at_once * at_once);
}

uint64_t rows_at_work_bytes(uint64_t num_columns, uint64_t num_mapped, uint64_t num_threads,
                            uint64_t num_blocks) {
    const uint64_t block =
        rows_per_block(static_cast<uint32_t>(num_columns)) * num_columns * sizeof(float);
    const uint64_t rows =
        static_cast<uint64_t>(kRowsAtOnce) * 2 * (num_columns + num_mapped) * sizeof(double);
    return std::min(num_threads, num_blocks) * (block + rows);
}

uint64_t triangular_factor_bytes(uint64_t num_columns, uint32_t num_in_flight) {
    const auto waiting = static_cast<uint64_t>(std::bit_width(kMaxInFlight / num_in_flight)) - 1;
    return (num_in_flight + waiting) * num_columns * num_columns * sizeof(double);
}

void centre_rows(const Eigen::Ref<const Eigen::MatrixXf>& block, MatrixXd& centred,
                 Eigen::VectorXd& mean) {
    centred.resize(block.rows(), block.cols());
    mean.setZero(block.rows());
    if (block.cols() == 0) return;
    // Differences to the first column first, which doubles hold exactly: rounding is then that of
    // what moves, however far from zero it does, and a row that is still gives zeros. Column by
    // column, as they lie in memory.
    const Eigen::VectorXd first = block.col(0).cast<double>();
    for (Index p = 0; p < block.cols(); ++p) {
        centred.col(p) = block.col(p).cast<double>() - first;
        mean += centred.col(p);
    }
    mean /= static_cast<double>(block.cols());
    centred.colwise() -= mean;
    mean += first;
}

MatrixXd triangular_factor(const RowSource& rows, Index num_columns, const RowMap& map,
                           uint32_t num_in_flight) {
    PAIM_CHECK(std::has_single_bit(num_in_flight) && num_in_flight <= kMaxInFlight);
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    const uint64_t num_blocks = (rows.num_rows() + block_rows - 1) / block_rows;
    const uint64_t num_runs = std::min<uint64_t>(kMaxInFlight, num_blocks);
    // Factors of 2^i runs that wait for their right neighbours, larger ones first: a tree's left
    // edge. Folding them as soon as they are complete gives the same tree for any number in flight.
    std::vector<Subtree> waiting;
    for (uint64_t first = 0; first < num_runs; first += num_in_flight) {
        std::vector<MatrixXd> factors(std::min<uint64_t>(num_in_flight, num_runs - first));
        parallel_for(factors.size(), 1, [&](size_t j, size_t) {
            const uint64_t run = first + j;
            factors[j] = factor_of_run(rows, num_columns, map, run * num_blocks / num_runs,
                                       (run + 1) * num_blocks / num_runs);
        });
        combine(factors);
        waiting.push_back({std::move(factors[0]), num_in_flight});
        while (waiting.size() > 1 && (waiting.end()[-2].num_runs == waiting.back().num_runs ||
                                      first + num_in_flight >= num_runs)) {
            fold_rows(waiting.end()[-2].factor, waiting.back().factor);
            waiting.end()[-2].num_runs *= 2;
            waiting.pop_back();
        }
    }
    if (waiting.empty()) return MatrixXd::Zero(num_columns, num_columns);
    return std::move(waiting[0].factor);
}

MatrixXd centred_triangular_factor(const RowSource& rows, uint32_t num_in_flight) {
    return triangular_factor(rows, static_cast<Index>(rows.num_columns()), {}, num_in_flight);
}

}  // namespace paim
