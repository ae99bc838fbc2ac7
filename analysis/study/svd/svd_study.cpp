// paim-svd-study: singular values and vectors of hard matrices by the encoder's way, and by the
// Gram matrix, which is the usual way, against long double. Prints docs/results/svd.md's table.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>

#include "analysis/study/svd/hard_matrices.h"
#include "analysis/study/svd/reference_svd.h"
#include "compressor/encode/svd/left_singular_vectors.h"
#include "paim/base/tbb_parallel.h"

namespace paim {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// √ of the eigenvalues of A'ᵀA', descending.
VectorXd gram_singular_values(const MatrixXd& centred) {
    const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(centred.transpose() * centred);
    return solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
}

double off_orthonormal(const MatrixXd& columns) {
    if (columns.cols() == 0) return 0.0;
    return (columns.transpose() * columns - MatrixXd::Identity(columns.cols(), columns.cols()))
        .cwiseAbs()
        .maxCoeff();
}

struct Errors {
    double absolute = 0.0;  // largest |s − exact| / s_0
    double relative = 0.0;  // largest |s − exact| / exact of the first `rank`
};

template <typename Values>
Errors errors(const Values& values, const std::vector<double>& exact, uint32_t rank) {
    Errors errors;
    if (exact.empty() || exact[0] == 0.0) return errors;
    for (size_t k = 0; k < exact.size(); ++k) {
        const double difference = std::abs(values[static_cast<Index>(k)] - exact[k]);
        errors.absolute = std::max(errors.absolute, difference / exact[0]);
        if (k < rank) errors.relative = std::max(errors.relative, difference / exact[k]);
    }
    return errors;
}

void study(const HardMatrix& hard) {
    const MatrixRows rows(hard.matrix);
    const PrincipalComponents components = principal_components(rows);
    const uint32_t rank = components.rank();
    const LeftVectors left(rows, components, rank);
    const double length = std::sqrt(static_cast<double>(hard.matrix.rows()));
    MatrixXd u(hard.matrix.rows(), static_cast<Index>(rank)), plain = u;
    left.project(hard.matrix, [&](Index first, const VectorXd&, const MatrixXd& factors) {
        u.middleRows(first, factors.rows()) = factors / length;
    });
    const LongMatrix exact_centred = centred_reference(hard.matrix);
    const MatrixXd centred = exact_centred.cast<double>();
    for (uint32_t k = 0; k < rank; ++k) {
        plain.col(k) = centred * components.v.col(k) / components.singular_values[k];
    }
    const std::vector<double> exact = singular_values_reference(exact_centred);
    const VectorXd ours = Eigen::Map<const VectorXd>(
        components.singular_values.data(), static_cast<Index>(components.singular_values.size()));
    const Errors our_errors = errors(ours, exact, rank);
    const Errors gram = errors(gram_singular_values(centred), exact, rank);
    const double smallest = rank > 0 ? exact[rank - 1] / exact[0] : 0.0;
    fmt::print(
        "| {} | {} x {} | {} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | {:.1e} | "
        "{:.1e} |\n",
        hard.name, hard.matrix.rows(), hard.matrix.cols(), rank, smallest, our_errors.absolute,
        gram.absolute, our_errors.relative, gram.relative, off_orthonormal(plain),
        off_orthonormal(u), off_orthonormal(components.v.leftCols(rank)));
}

}  // namespace

}  // namespace paim

int main() {
    paim::use_tbb();
    fmt::print(
        "| matrix | rows x poses | rank | s_min/s_0 | error of s | Gram | relative error of s | "
        "Gram | "
        "A'V/S off orthonormal | U | V |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const paim::HardMatrix& hard : paim::hard_matrices()) paim::study(hard);
    return 0;
}
