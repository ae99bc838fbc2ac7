// Left singular vectors, a few rows at a time.
// Based on: Björck, Numerical Methods for Least Squares Problems, 1996 (see the header)
#include "compressor/encode/svd/left_singular_vectors.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "paim/base/check.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

// How far from zero products of columns of A' V S⁻¹ may be, for P poses: they are u_j · A'
// v_k / s_k, and u_j · A' v_k is off by up to P/3 · 2^-52 s_0 (measured, 6 to 103 poses).
double uncorrected(const PrincipalComponents& components, uint32_t num_components) {
    const double ratio =
        components.singular_values[0] / components.singular_values[num_components - 1];
    return static_cast<double>(components.v.rows()) * std::numeric_limits<double>::epsilon() *
           ratio;
}

// √rows R⁻¹ with a positive diagonal, R the triangular factor of columns of unit RMS.
MatrixXd inverse_factor(const MatrixXd& factor, double length) {
    const Index n = factor.cols();
    MatrixXd inverse =
        factor.triangularView<Eigen::Upper>().solve(MatrixXd(length * MatrixXd::Identity(n, n)));
    for (Index k = 0; k < n; ++k) {
        if (factor(k, k) < 0.0) inverse.col(k) *= -1.0;
    }
    return inverse;
}

}  // namespace

LeftVectors::LeftVectors(const RowSource& rows, const PrincipalComponents& components,
                         uint32_t num_components, double orthonormal_to, uint32_t num_in_flight)
    : projection_(components.v.leftCols(num_components)) {
    PAIM_CHECK_LE(num_components, components.rank());
    const double length = std::sqrt(static_cast<double>(rows.num_rows()));
    const auto& s = components.singular_values;
    for (uint32_t k = 0; k < num_components; ++k) projection_.col(k) *= length / s[k];
    if (num_components == 0 || uncorrected(components, num_components) <= orthonormal_to) return;
    const MatrixXd factor = triangular_factor(
        rows.silent(), num_components,
        [&](const MatrixXd& centred, MatrixXd& factors) {
            factors.noalias() = centred * projection_;
        },
        num_in_flight);
    correction_ = inverse_factor(factor, length);
}

void LeftVectors::project(const Eigen::MatrixXf& block, const OnRows& on_rows) const {
    MatrixXd centred, factors;
    Eigen::VectorXd mean;
    for (Index row = 0; row < block.rows(); row += kRowsAtOnce) {
        centre_rows(block.middleRows(row, std::min(kRowsAtOnce, block.rows() - row)), centred,
                    mean);
        factors.noalias() = centred * projection_;
        if (corrected()) factors *= correction_.triangularView<Eigen::Upper>();
        on_rows(row, mean, factors);
    }
}

}  // namespace paim
