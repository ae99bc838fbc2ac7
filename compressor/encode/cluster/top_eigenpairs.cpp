// Subspace iteration.
// Based on: Rutishauser 1970 (see the header)
#include "compressor/encode/cluster/top_eigenpairs.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>

#include "paim/base/seed.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

Index iterated_directions(Index wanted, Index n) {
    return std::min(n, wanted + std::max<Index>(8, wanted / 2));
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

Eigenpairs top_eigenpairs(const MatrixXd& gram, Index wanted, uint64_t key) {
    const Index n = gram.rows();
    wanted = std::min(wanted, n);
    const Index iterated = iterated_directions(wanted, n);
    // Measured: from about here on iterating is the faster of the two.
    if (n <= 4 * iterated) {
        const Eigenpairs all = all_eigenpairs(gram);
        return {all.values.head(wanted).cwiseMax(0.0), all.vectors.leftCols(wanted)};
    }
    constexpr int kMaxSteps = 200, kStepsACheck = 2;
    RandomStream random(key);
    MatrixXd q = MatrixXd::NullaryExpr(n, iterated, [&] { return random.uniform() - 0.5; });
    q = orthonormal_basis(q);
    Eigenpairs pairs;
    double sum = 0.0;
    for (int step = 0; step < kMaxSteps; step += kStepsACheck) {
        for (int s = 0; s < kStepsACheck; ++s) q = orthonormal_basis(gram * q);
        pairs = ritz_pairs(q, gram * q, wanted);
        const double next = pairs.values.sum();
        if (next - sum <= 0x1p-40 * gram.trace()) break;
        sum = next;
    }
    return pairs;
}

uint64_t top_eigenpairs_scratch_bytes(uint64_t n, uint64_t wanted) {
    const auto iterated = static_cast<uint64_t>(
        iterated_directions(static_cast<Index>(wanted), static_cast<Index>(n)));
    return n * std::min(n, 6 * iterated) * sizeof(double);
}

}  // namespace paim
