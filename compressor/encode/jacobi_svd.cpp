// One-sided Jacobi.
// Based on: Hestenes 1958; de Rijk 1989; Demmel and Veselić 1992 (see the header)
#include "compressor/encode/jacobi_svd.h"

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

// Turns columns p and q of both matrices so that those of `work` become orthogonal. Returns whether
// they were not.
bool orthogonalise(MatrixXd& work, MatrixXd& v, Index p, Index q) {
    const double alpha = work.col(p).squaredNorm();
    const double beta = work.col(q).squaredNorm();
    const double gamma = work.col(p).dot(work.col(q));
    const double tolerance =
        std::numeric_limits<double>::epsilon() * std::sqrt(static_cast<double>(work.rows()));
    if (std::abs(gamma) <= tolerance * std::sqrt(alpha) * std::sqrt(beta)) return false;
    const double zeta = (beta - alpha) / (2.0 * gamma);
    const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
    const double c = 1.0 / std::hypot(1.0, t);
    const double s = c * t;
    for (MatrixXd* m : {&work, &v}) {
        for (Index row = 0; row < m->rows(); ++row) {
            const double a = (*m)(row, p);
            const double b = (*m)(row, q);
            (*m)(row, p) = c * a - s * b;
            (*m)(row, q) = s * a + c * b;
        }
    }
    return true;
}

}  // namespace

SmallSvd jacobi_svd(const MatrixXd& matrix) {
    PAIM_CHECK_EQ(matrix.rows(), matrix.cols());
    PAIM_CHECK(matrix.allFinite());
    constexpr int kMaxSweeps = 60;  // convergence is quadratic; ten is usual
    const Index n = matrix.cols();
    // Scaled so that squares of the entries neither overflow nor vanish.
    const double scale = n > 0 ? matrix.cwiseAbs().maxCoeff() : 0.0;
    MatrixXd work = scale > 0.0 ? MatrixXd(matrix / scale) : matrix;
    MatrixXd v = MatrixXd::Identity(n, n);
    bool turned = true;
    for (int sweep = 0; turned && sweep < kMaxSweeps; ++sweep) {
        turned = false;
        for (Index p = 0; p + 1 < n; ++p) {
            // De Rijk's pivoting: the largest remaining column first.
            Index largest = p;
            work.rightCols(n - p).colwise().squaredNorm().maxCoeff(&largest);
            largest += p;
            if (largest != p && largest < n) {
                work.col(p).swap(work.col(largest));
                v.col(p).swap(v.col(largest));
            }
            for (Index q = p + 1; q < n; ++q) turned |= orthogonalise(work, v, p, q);
        }
    }
    const Eigen::VectorXd norms = work.colwise().norm().transpose();
    std::vector<Index> order(static_cast<size_t>(n));
    std::iota(order.begin(), order.end(), Index{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](Index a, Index b) { return norms[a] > norms[b]; });
    SmallSvd svd{Eigen::VectorXd(n), MatrixXd(n, n)};
    for (Index k = 0; k < n; ++k) {
        const Index from = order[static_cast<size_t>(k)];
        svd.singular_values[k] = scale * norms[from];
        Index largest = 0;
        v.col(from).cwiseAbs().maxCoeff(&largest);
        svd.v.col(k) = v(largest, from) < 0.0 ? Eigen::VectorXd(-v.col(from)) : v.col(from);
    }
    return svd;
}

}  // namespace paim
