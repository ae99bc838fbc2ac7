// The principal components of a data matrix (E4): A' = U S Vᵀ, streamed by blocks of rows.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and Kry 2012
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "compressor/encode/jacobi_svd.h"
#include "compressor/encode/row_source.h"

namespace paim {

// Singular values and right singular vectors of the centred matrix.
struct PrincipalComponents {
    std::vector<double> singular_values;  // [min(rows, P)], descending
    Eigen::MatrixXd v;                    // [P][min(rows, P)]

    // How many singular values are more than rounding: above P · 2⁻⁵² of the largest, and at most
    // P − 1, since centring takes one.
    uint32_t rank() const;
};

PrincipalComponents principal_components(const RowSource& rows);

// Weights of the first num_components components as the .paim holds them: W_kp = s_k V_pk / √rows, so
// that components have unit RMS. returns [K][P]
std::vector<float> component_weights(const PrincipalComponents& components, uint32_t num_components,
                                     uint64_t num_rows);

// What a block of rows becomes: its mean and its rows of the first K components (unit RMS).
struct EncodedRows {
    std::vector<float> mean;                     // [rows of the block]
    std::vector<std::vector<float>> components;  // [K][rows of the block]
};

// Calls on_block for consecutive blocks of rows, in order, from one thread.
void for_each_encoded_block(const RowSource& rows, const PrincipalComponents& components,
                            uint32_t num_components,
                            const std::function<void(const EncodedRows&)>& on_block);

}  // namespace paim
