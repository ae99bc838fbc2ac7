// The rows of the components, streamed by blocks of rows of the data.
// Based on: Alexa and Müller 2000 (see the header)
#include "compressor/encode/svd/projected_blocks.h"

#include <algorithm>

#include "compressor/encode/svd/left_singular_vectors.h"
#include "compressor/encode/svd/tsqr.h"
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

void for_each_encoded_block(const RowSource& rows, const PrincipalComponents& components,
                            uint32_t num_components,
                            const std::function<void(EncodedRows&)>& on_block,
                            uint32_t num_in_flight) {
    // A 64th of what the rounding to float does, so that it cannot show: the pass that 1e-12 takes
    // A 64th of the rounding to float, so that it cannot show. A correction to 1e-12 would take
    // another pass over the rows for nothing.
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

uint64_t encoded_blocks_bytes(uint64_t num_columns, uint64_t num_components,
                              uint32_t num_in_flight) {
    const uint64_t block =
        rows_per_block(static_cast<uint32_t>(num_columns)) * (num_components + 1) * sizeof(float);
    const uint64_t done = std::min<uint64_t>(num_in_flight, kMaxBlocksWaiting) * block;
    return LeftVectors::scratch_bytes(num_columns, num_components) +
           std::max(triangular_factor_bytes(num_components, num_in_flight), done);
}

}  // namespace paim
