// Left singular vectors, a few rows at a time: U = A' V S⁻¹, orthonormal to rounding whatever s_k.
// Based on: Björck, Numerical Methods for Least Squares Problems, 1996, section 2.4 (orthogonality
//           lost, and regained by orthogonalising again)
#pragma once

#include "compressor/encode/svd/principal_components.h"
#include "compressor/encode/svd/tsqr.h"

namespace paim {

// A' V S⁻¹ alone is orthonormal only to the roundings of R and V, which are of the size of s_0: to
// some P · 2^-52 s_0/s_k. Where that is more than is asked for, the triangular factor of those very
// columns is computed in another pass over the rows, and U = (A' V S⁻¹) R⁻¹, orthonormal to a few
// 2^-53. The change of U S Vᵀ is a rounding of s_0.
class LeftVectors {
  public:
    // rows            read through only if a correction is needed
    // num_components  at most components.rank()
    // orthonormal_to  the most that an entry of UᵀU − 1 may be, 1e-12 or more
    LeftVectors(const RowSource& rows, const PrincipalComponents& components,
                uint32_t num_components, double orthonormal_to = 1e-12,
                uint32_t num_in_flight = kMaxInFlight);

    bool corrected() const { return correction_.size() > 0; }

    // Rows of the data, centred, become rows of the components (unit RMS over all rows).
    // on_rows(first, mean, factors): `mean` and the rows of `factors` belong to rows first,
    // first + 1, …
    // note  a block must begin at a multiple of kRowsAtOnce, so that every pass rounds alike
    using OnRows = std::function<void(Eigen::Index first, const Eigen::VectorXd& mean,
                                      const Eigen::MatrixXd& factors)>;
    void project(const Eigen::MatrixXf& block, const OnRows& on_rows) const;

    // Memory of P columns and K components while the correction is computed, in addition to its
    // triangular factors: V S⁻¹, and the correction with its temporaries.
    static constexpr uint64_t scratch_bytes(uint64_t num_columns, uint64_t num_components) {
        return (num_columns + 3 * num_components) * num_components * sizeof(double);
    }

  private:
    Eigen::MatrixXd projection_;  // [P][K] V S⁻¹, times √rows for unit RMS
    Eigen::MatrixXd correction_;  // [K][K] upper triangular, or empty
};

}  // namespace paim
