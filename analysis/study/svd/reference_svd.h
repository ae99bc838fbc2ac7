// Slow reference of singular values: one-sided Jacobi in long double on the whole centred
// matrix, without scaling, pivoting, blocks or QR.
// Based on: Hestenes, Inversion of Matrices by Biorthogonalization and Related Results, 1958
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace paim {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

inline LongMatrix centred_reference(const Eigen::MatrixXf& matrix) {
    LongMatrix centred = matrix.cast<long double>();
    const LongMatrix first = centred.leftCols(1);
    centred.colwise() -= first.col(0);  // exact: far from zero the mean would round
    const LongMatrix mean = centred.rowwise().mean();
    centred.colwise() -= mean.col(0);
    return centred;
}

// returns [min(rows, columns)], descending. 64 bits of mantissa: errors of 1e-19 of the largest,
// times a few; the exponent's 15 bits hold the squares of all doubles.
inline std::vector<double> singular_values_reference(LongMatrix work) {
    if (work.rows() < work.cols()) work = LongMatrix(work.transpose());
    bool turned = true;
    for (int sweep = 0; turned && sweep < 100; ++sweep) {
        turned = false;
        for (Eigen::Index p = 0; p + 1 < work.cols(); ++p) {
            for (Eigen::Index q = p + 1; q < work.cols(); ++q) {
                const long double alpha = work.col(p).squaredNorm();
                const long double beta = work.col(q).squaredNorm();
                const long double gamma = work.col(p).dot(work.col(q));
                if (std::abs(gamma) <= 1e-18L * std::sqrt(alpha) * std::sqrt(beta)) continue;
                const long double angle = 0.5L * std::atan2(2.0L * gamma, beta - alpha);
                const long double c = std::cos(angle), s = std::sin(angle);
                const LongMatrix a = c * work.col(p) - s * work.col(q);
                work.col(q) = s * work.col(p) + c * work.col(q);
                work.col(p) = a;
                turned = true;
            }
        }
    }
    std::vector<double> values;
    for (Eigen::Index k = 0; k < work.cols(); ++k) {
        values.push_back(static_cast<double>(work.col(k).norm()));
    }
    std::sort(values.begin(), values.end(), std::greater<>());
    return values;
}

}  // namespace paim
