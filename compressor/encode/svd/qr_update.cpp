// Folds more rows into a triangular factor, by panels of columns.
// Based on: Golub and Van Loan, 2013; Schreiber and Van Loan, 1989 (see the header)
#include "compressor/encode/svd/qr_update.h"

#include <algorithm>
#include <cmath>

#include "paim/base/check.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Columns that are reduced one by one before the rest follows in matrix products.
constexpr Index kPanel = 16;

// Reduces columns [first, first + tau.size()). Reflection j is 1 − tau_j v vᵀ, where v is 1 at row
// j of R and, at the new rows, what is left in column j.
void reduce_panel(MatrixXd& r, MatrixXd& rows, Index first, VectorXd& tau) {
    const Index end = first + tau.size();
    for (Index j = first; j < end; ++j) {
        const double diagonal = r(j, j);
        const double below = rows.col(j).squaredNorm();
        tau[j - first] = 0.0;
        if (below == 0.0) continue;
        const double length = std::sqrt(diagonal * diagonal + below);
        const double reflected = -std::copysign(length, diagonal);  // away from cancellation
        const double head = diagonal - reflected;
        tau[j - first] = -head / reflected;
        rows.col(j) *= 1.0 / head;
        r(j, j) = reflected;
        const Index rest = end - j - 1;
        Eigen::RowVectorXd step = r.row(j).segment(j + 1, rest);
        step.noalias() += rows.col(j).transpose() * rows.middleCols(j + 1, rest);
        step *= tau[j - first];
        r.row(j).segment(j + 1, rest) -= step;
        rows.middleCols(j + 1, rest).noalias() -= rows.col(j) * step;
    }
}

// T of the compact form 1 − V T Vᵀ of a panel's reflections, upper triangular.
template <typename Panel>
MatrixXd compact_factor(const Panel& v, const VectorXd& tau) {
    const Index size = tau.size();
    // The parts of V in R are different rows of the identity: only the new rows meet.
    MatrixXd products = MatrixXd::Zero(size, size);
    products.template triangularView<Eigen::StrictlyUpper>() = v.transpose() * v;
    MatrixXd t = MatrixXd::Zero(size, size);
    for (Index j = 0; j < size; ++j) {
        const VectorXd column =
            t.topLeftCorner(j, j).template triangularView<Eigen::Upper>() * products.col(j).head(j);
        t.col(j).head(j) = -tau[j] * column;
        t(j, j) = tau[j];
    }
    return t;
}

}  // namespace

void fold_rows(MatrixXd& r, MatrixXd& rows) {
    PAIM_CHECK_EQ(r.rows(), r.cols());
    PAIM_CHECK_EQ(rows.cols(), r.cols());
    if (rows.rows() == 0) return;
    const Index n = r.cols();
    for (Index first = 0; first < n; first += kPanel) {
        const Index size = std::min(kPanel, n - first);
        const Index rest = n - first - size;
        VectorXd tau(size);
        reduce_panel(r, rows, first, tau);
        if (rest == 0) break;
        const auto v = rows.middleCols(first, size);
        MatrixXd step = r.block(first, first + size, size, rest);
        step.noalias() += v.transpose() * rows.rightCols(rest);
        step = (compact_factor(v, tau).transpose() * step).eval();
        r.block(first, first + size, size, rest) -= step;
        rows.rightCols(rest).noalias() -= v * step;
    }
}

}  // namespace paim
