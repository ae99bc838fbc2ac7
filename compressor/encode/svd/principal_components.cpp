// The principal components of a data matrix, streamed.
// Based on: Alexa and Müller, Representing Animations by Principal Components, 2000; Cardoso and
//           Kry 2012
#include "compressor/encode/svd/principal_components.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compressor/encode/svd/left_singular_vectors.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

EncodedRows encode_block(const RowSource& rows, uint64_t first, uint64_t count,
                         const LeftVectors& left, uint32_t num_components) {
    Eigen::MatrixXf block(static_cast<Index>(count), static_cast<Index>(rows.num_columns()));
    rows.read(first, block);
    EncodedRows encoded;
    encoded.mean.resize(count);
    encoded.components.resize(num_components);
    for (auto& component : encoded.components) component.resize(count);
    left.project(block, [&](Index row, const Eigen::VectorXd& mean, const MatrixXd& factors) {
        const Index size = factors.rows();
        Eigen::Map<Eigen::VectorXf>(encoded.mean.data() + row, size) = mean.cast<float>();
        for (Index k = 0; k < factors.cols(); ++k) {
            float* component = encoded.components[static_cast<size_t>(k)].data();
            Eigen::Map<Eigen::VectorXf>(component + row, size) = factors.col(k).cast<float>();
        }
    });
    return encoded;
}

}  // namespace

uint32_t PrincipalComponents::rank() const {
    if (singular_values.empty()) return 0;
    const auto num_poses = v.rows();
    // Reducing P columns rounds about P times. So does each of the folds of kRowsAtOnce rows, by
    // less than 2^-52 of the largest value and at random: √folds. Measured on matrices of exactly
    // known rank: at most a third (6.6 · 2^-52 of 6 poses and a million rows).
    const double num_folds = static_cast<double>(num_rows) / static_cast<double>(kRowsAtOnce);
    const double floor = singular_values[0] *
                         (static_cast<double>(num_poses) + std::sqrt(num_folds)) *
                         std::numeric_limits<double>::epsilon();
    const auto above = std::count_if(singular_values.begin(), singular_values.end(),
                                     [&](double s) { return s > floor; });
    return static_cast<uint32_t>(std::min<Index>(above, num_poses - 1));
}

PrincipalComponents principal_components(const RowSource& rows, uint32_t num_in_flight) {
    // With fewer rows than columns the factor has that many rows; the others are zero.
    const auto count = static_cast<Index>(std::min<uint64_t>(rows.num_rows(), rows.num_columns()));
    SmallSvd svd = jacobi_svd(centred_triangular_factor(rows, num_in_flight).topRows(count));
    PrincipalComponents components;
    components.singular_values.assign(svd.singular_values.begin(), svd.singular_values.end());
    components.v = std::move(svd.v);
    components.num_rows = rows.num_rows();
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
                            const std::function<void(EncodedRows&)>& on_block,
                            uint32_t num_in_flight) {
    // A 64th of what the rounding to float does, so that it cannot show: the pass that 1e-12 takes
    // would be for nothing.
    constexpr double kAsStored = 0x1p-30;
    const LeftVectors left(rows, components, num_components, kAsStored, num_in_flight);
    const uint64_t block_rows = rows_per_block(rows.num_columns());
    const uint64_t num_blocks = (rows.num_rows() + block_rows - 1) / block_rows;
    const uint64_t at_once = std::min(num_in_flight, kMaxBlocksWaiting);
    for (uint64_t round = 0; round < num_blocks; round += at_once) {
        std::vector<EncodedRows> encoded(std::min(at_once, num_blocks - round));
        parallel_for(encoded.size(), 1, [&](size_t j, size_t) {
            const uint64_t first = (round + j) * block_rows;
            encoded[j] = encode_block(rows, first, std::min(block_rows, rows.num_rows() - first),
                                      left, num_components);
        });
        for (EncodedRows& block : encoded) on_block(block);
    }
}

}  // namespace paim
