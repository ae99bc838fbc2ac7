// Positions of some vertices over all poses, block by block.
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>

#include "compressor/encode/data/row_source.h"
#include "compressor/encode/svd/tsqr.h"

namespace paim {

// Planes x, y and z of some vertices, [count][P] each.
using PositionBlock = std::array<Eigen::MatrixXf, 3>;

// Reads vertices first, … first + count − 1 into `block` and calls use(first, count), for all vertices
// in turn.
// rows  planes x, y and z of V rows each
template <typename Use>
void for_each_position_block(const RowSource& rows, PositionBlock& block, const Use& use) {
    const uint64_t num_vertices = rows.num_rows() / 3;
    // Three planes of so many rows are as large as a block of any other pass.
    const uint64_t at_once = std::max<uint64_t>(1, rows_per_block(rows.num_columns()) / 3);
    for (uint64_t first = 0; first < num_vertices; first += at_once) {
        const uint64_t count = std::min(at_once, num_vertices - first);
        for (uint64_t axis = 0; axis < 3; ++axis) {
            block[axis].resize(static_cast<Eigen::Index>(count),
                               static_cast<Eigen::Index>(rows.num_columns()));
            rows.read(axis * num_vertices + first, block[axis]);
        }
        use(first, count);
    }
}

}  // namespace paim
