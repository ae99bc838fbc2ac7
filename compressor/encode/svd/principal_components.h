// The principal components of a data matrix (E4): A' = U S Vᵀ, streamed by blocks of rows.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and
//           Kry 2012
#pragma once

#include <functional>
#include <span>
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

// Weights of the first num_components components as the .paim holds them: W_kp = s_k V_pk / √rows,
// so that components have unit RMS. returns [K][P]
std::vector<float> component_weights(const PrincipalComponents& components, uint32_t num_components,
                                     uint64_t num_rows);

// Blocks that for_each_encoded_block() works on before it hands them on in order; at most that
// many.
constexpr uint32_t kMaxBlocksWaiting = 16;

// What a block of rows becomes: its mean and its rows of the first K components (unit RMS).
struct EncodedRows {
    std::vector<float> mean;                     // [rows of the block]
    std::vector<std::vector<float>> components;  // [K][rows of the block]
};

// Calls on_block for consecutive blocks of rows, in order, from one thread.
void for_each_encoded_block(const RowSource& rows, const PrincipalComponents& components,
                            uint32_t num_components,
                            const std::function<void(EncodedRows&)>& on_block,
                            uint32_t num_in_flight = kMaxInFlight);

}  // namespace paim
