// The principal components of a data matrix, streamed.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and Kry 2012
#include "compressor/encode/principal_components.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compressor/encode/tsqr.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

// Blocks that are worked on at once before they are handed on in order.
constexpr uint64_t kBlocksPerRound = 16;

EncodedRows encode_block(const RowSource& rows, uint64_t first, uint64_t count,
                         const MatrixXd& projection) {
    Eigen::MatrixXf block(static_cast<Index>(count), static_cast<Index>(rows.num_columns()));
    rows.read(first, block);
    EncodedRows encoded;
    encoded.mean.resize(count);
    encoded.components.resize(static_cast<size_t>(projection.cols()));
    for (auto& component : encoded.components) component.resize(count);
    MatrixXd centred, scores;
    Eigen::VectorXd mean;
    for (Index row = 0; row < block.rows(); row += kRowsAtOnce) {
        const Index size = std::min(kRowsAtOnce, block.rows() - row);
        centre_rows(block.middleRows(row, size), centred, mean);
        scores.noalias() = centred * projection;
        Eigen::Map<Eigen::VectorXf>(encoded.mean.data() + row, size) = mean.cast<float>();
        for (Index k = 0; k < projection.cols(); ++k) {
            float* component = encoded.components[static_cast<size_t>(k)].data();
            Eigen::Map<Eigen::VectorXf>(component + row, size) = scores.col(k).cast<float>();
        }
    }
    return encoded;
}

}  // namespace

uint32_t PrincipalComponents::rank() const {
    if (singular_values.empty()) return 0;
    const auto num_poses = v.rows();
    const double floor = singular_values[0] * static_cast<double>(num_poses) *
                         std::numeric_limits<double>::epsilon();
    const auto above = std::count_if(singular_values.begin(), singular_values.end(),
                                     [&](double s) { return s > floor; });
    return static_cast<uint32_t>(std::min<Index>(above, num_poses - 1));
}

PrincipalComponents principal_components(const RowSource& rows) {
    // With fewer rows than columns the factor has that many rows; the others are zero.
    const auto count = static_cast<Index>(std::min<uint64_t>(rows.num_rows(), rows.num_columns()));
    SmallSvd svd = jacobi_svd(centred_triangular_factor(rows).topRows(count));
    PrincipalComponents components;
    components.singular_values.assign(svd.singular_values.begin(), svd.singular_values.end());
    components.v = std::move(svd.v);
    return components;
}

std::vector<float> component_weights(const PrincipalComponents& components, uint32_t num_components,
                                     uint64_t num_rows) {
    const auto num_poses = static_cast<uint32_t>(components.v.rows());
    const double to_unit_rms = 1.0 / std::sqrt(static_cast<double>(num_rows));
    std::vector<float> weights(size_t{num_components} * num_poses);
    for (uint32_t k = 0; k < num_components; ++k) {
        for (uint32_t p = 0; p < num_poses; ++p) {
            weights[size_t{k} * num_poses + p] = static_cast<float>(
                components.singular_values[k] * components.v(p, k) * to_unit_rms);
        }
    }
    return weights;
}

void for_each_encoded_block(const RowSource& rows, const PrincipalComponents& components,
                            uint32_t num_components,
                            const std::function<void(const EncodedRows&)>& on_block) {
    PAIM_CHECK_LE(num_components, components.rank());
    // U = A' V S⁻¹, times √rows for unit RMS.
    MatrixXd projection = components.v.leftCols(num_components);
    for (uint32_t k = 0; k < num_components; ++k) {
        projection.col(k) *=
            std::sqrt(static_cast<double>(rows.num_rows())) / components.singular_values[k];
    }
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    const uint64_t num_blocks = (rows.num_rows() + block_rows - 1) / block_rows;
    for (uint64_t round = 0; round < num_blocks; round += kBlocksPerRound) {
        std::vector<EncodedRows> encoded(std::min(kBlocksPerRound, num_blocks - round));
        parallel_for(encoded.size(), 1, [&](size_t j, size_t) {
            const uint64_t first = (round + j) * block_rows;
            encoded[j] = encode_block(rows, first, std::min(block_rows, rows.num_rows() - first),
                                      projection);
        });
        for (const EncodedRows& block : encoded) on_block(block);
    }
}

}  // namespace paim
