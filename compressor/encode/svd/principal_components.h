// The principal components of a data matrix (E4): A' = U S Vᵀ, streamed by blocks of rows.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and
//           Kry 2012
#pragma once

#include <vector>

#include "compressor/encode/data/row_source.h"
#include "compressor/encode/svd/jacobi_svd.h"
#include "compressor/encode/svd/tsqr.h"

namespace paim {

// Singular values and right singular vectors of the centred matrix.
struct PrincipalComponents {
    std::vector<double> singular_values;  // [min(rows, P)], descending
    Eigen::MatrixXd v;                    // [P][min(rows, P)]

    uint64_t num_rows = 0;  // of the matrix

    // How many singular values are more than rounding: above (P + √(rows / 256)) · 2⁻⁵² of the
    // largest, and at most P − 1, since centring takes one. The data's own floats count as exact:
    // what their rounding to 2⁻²⁴ put into them is a component like any other.
    uint32_t rank() const;
};

// num_in_flight  blocks of rows that are worked on at once, a power of two to kMaxInFlight: fewer
//                need less memory and give the same bytes
PrincipalComponents principal_components(const RowSource& rows,
                                         uint32_t num_in_flight = kMaxInFlight);

// Memory that the result holds for P columns: V.
constexpr uint64_t principal_components_bytes(uint64_t num_columns) {
    return num_columns * num_columns * sizeof(double);
}

// Weights of the first num_components components as the .paim holds them: W_kp = s_k V_pk / √rows,
// so that components have unit RMS. returns [K][P]
std::vector<float> component_weights(const PrincipalComponents& components, uint32_t num_components,
                                     uint64_t num_rows);

}  // namespace paim
