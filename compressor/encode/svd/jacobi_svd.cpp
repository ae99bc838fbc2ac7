// One-sided Jacobi.
// Based on: Hestenes 1958; de Rijk 1989; Demmel and Veselić 1992 (see the header)
#include "compressor/encode/svd/jacobi_svd.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "paim/base/check.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// Turns columns p and q so that they become orthogonal. Returns whether they were not. Pairs
// shorter than `negligible` are rounding, which would never come to rest.
bool orthogonalise(MatrixXd& work, Index p, Index q, double negligible) {
    const double alpha = work.col(p).squaredNorm();
    const double beta = work.col(q).squaredNorm();
    const double gamma = work.col(p).dot(work.col(q));
    const double lengths = std::sqrt(alpha) * std::sqrt(beta);
    const double tolerance = kEpsilon * std::sqrt(static_cast<double>(work.rows()));
    if (std::abs(gamma) <= tolerance * lengths || lengths <= negligible * negligible) return false;
    const double zeta = (beta - alpha) / (2.0 * gamma);
    const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
    const double c = 1.0 / std::hypot(1.0, t);
    const double s = c * t;
    double* a = work.col(p).data();
    double* b = work.col(q).data();
    for (Index row = 0; row < work.rows(); ++row) {
        const double turned = c * a[row] - s * b[row];
        b[row] = s * a[row] + c * b[row];
        a[row] = turned;
    }
    return true;
}

// Swaps the longest of the columns from p on to place p (de Rijk's pivoting).
void bring_longest_to(MatrixXd& work, Index p) {
    Index longest = 0;
    work.rightCols(work.cols() - p).colwise().squaredNorm().maxCoeff(&longest);
    if (longest != 0) work.col(p).swap(work.col(p + longest));
}

}  // namespace

SmallSvd jacobi_svd(const MatrixXd& matrix) {
    PAIM_CHECK_LE(matrix.rows(), matrix.cols());
    PAIM_CHECK(matrix.allFinite());
    // Convergence is quadratic, ten sweeps are usual; what sixty leave is rounding.
    constexpr int kMaxSweeps = 60;
    const Index m = matrix.rows();
    // The transpose is V S Uᵀ: once its columns are orthogonal, they are those of V S, and no
    // rotation needs to be remembered. Scaled so that squares of the entries neither overflow nor
    // vanish.
    const double scale = m > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0;
    MatrixXd work = scale > 0.0 ? MatrixXd(matrix.transpose() / scale) : matrix.transpose();
    bool turned = scale > 0.0;
    for (int sweep = 0; turned && sweep < kMaxSweeps; ++sweep) {
        turned = false;
        for (Index p = 0; p + 1 < m; ++p) {
            bring_longest_to(work, p);
            const double negligible = kEpsilon * work.col(0).norm();
            for (Index q = p + 1; q < m; ++q) turned |= orthogonalise(work, p, q, negligible);
        }
    }
    const Eigen::VectorXd lengths = work.colwise().norm().transpose();
    std::vector<Index> order(static_cast<size_t>(m));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return lengths[a] > lengths[b]; });
    SmallSvd svd{Eigen::VectorXd(m), MatrixXd::Zero(matrix.cols(), m)};
    for (Index k = 0; k < m; ++k) {
        const Index from = order[static_cast<size_t>(k)];
        svd.singular_values[k] = scale * lengths[from];
        if (lengths[from] == 0.0) continue;
        Index largest = 0;
        work.col(from).cwiseAbs().maxCoeff(&largest);
        svd.v.col(k) = work.col(from) / std::copysign(lengths[from], work(largest, from));
    }
    return svd;
}

}  // namespace paim
