// Subspace iteration.
// Based on: Rutishauser 1970 (see the header)
#include "compressor/encode/cluster/top_eigenpairs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <utility>

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

Index iterated_directions(Index wanted, Index n) {
    return std::min(n, wanted + std::max<Index>(8, wanted / 2));
}

bool is_iterated(Index wanted, Index n) {
    // Measured: from about here on iterating is the faster of the two.
    return n > 4 * iterated_directions(wanted, n);
}

Eigenpairs all_eigenpairs(const MatrixXd& symmetric) {
    if (symmetric.rows() == 0) return {};
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(symmetric);
    return {solver.eigenvalues().reverse(), solver.eigenvectors().rowwise().reverse()};
}

MatrixXd orthonormal_basis(const MatrixXd& columns) {
    const Eigen::HouseholderQR<MatrixXd> qr(columns);
    return qr.householderQ() * MatrixXd::Identity(columns.rows(), columns.cols());
}

Eigenpairs ritz_pairs(const MatrixXd& q, const MatrixXd& gram_q, Index wanted) {
    MatrixXd within = q.transpose() * gram_q;
    within = 0.5 * (within + within.transpose()).eval();
    const Eigenpairs all = all_eigenpairs(within);
    wanted = std::min(wanted, q.cols());
    return {all.values.head(wanted).cwiseMax(0.0), q * all.vectors.leftCols(wanted)};
}

Eigenpairs top_eigenpairs(const MatrixXd& gram, Index wanted, MatrixXd start) {
    const Index n = gram.rows();
    wanted = std::min(wanted, n);
    if (!is_iterated(wanted, n)) {
        const Eigenpairs all = all_eigenpairs(gram);
        return {all.values.head(wanted).cwiseMax(0.0), all.vectors.leftCols(wanted)};
    }
    constexpr int kMaxSteps = 200;
    constexpr double kOfWhatIsLeft = 1e-4, kOfAll = 0x1p-40;
    const double all = gram.trace();
    MatrixXd q = std::move(start);
    MatrixXd gram_q = gram * q;
    Eigenpairs pairs = ritz_pairs(q, gram_q, wanted);
    for (int step = 0; step < kMaxSteps; ++step) {
        const double sum = pairs.values.sum();
        q = orthonormal_basis(gram_q);
        gram_q.noalias() = gram * q;
        pairs = ritz_pairs(q, gram_q, wanted);
        const double next = pairs.values.sum();
        if (next - sum <= std::max(kOfAll * all, kOfWhatIsLeft * (all - next))) break;
    }
    return pairs;
}

uint64_t top_eigenpairs_scratch_bytes(uint64_t n, uint64_t wanted) {
    const auto iterated = static_cast<uint64_t>(
        iterated_directions(static_cast<Index>(wanted), static_cast<Index>(n)));
    return n * std::min(n, 6 * iterated) * sizeof(double);
}

}  // namespace paim
