// The data matrices of a bake.
#include "compressor/encode/data/bake_rows.h"

#include <algorithm>

#include "paim/base/check.h"
#include "paim/mesh/face_vertices.h"
#include "paim/metrics/geometry_error.h"

namespace paim {

void GeometryRows::read(uint64_t first, Eigen::MatrixXf& block) const {
    for (uint32_t p = 0; p < num_columns(); ++p) {
        float* const rows = block.col(p).data();
        const auto count = static_cast<size_t>(block.rows());
        bake_.read_position_rows(p, first, count, rows);
        outliers_.replace(p, bake_.identity().num_vertices, first, {rows, count});
    }
}

TransferRows::TransferRows(const BakeReader& bake, uint32_t bands, Content content)
    : bake_(bake),
      content_(content),
      layout_(bake.identity().layout),
      num_vertices_(bake.identity().num_vertices) {
    PAIM_CHECK(bands >= 1 && bands <= layout_.in_bands);
    layout_.in_bands = bands;
}

void TransferRows::read(uint64_t first, Eigen::MatrixXf& block) const {
    // Within a channel the kept planes come first, so they are contiguous in the bake.
    const uint64_t kept_per_channel = layout_.num_coefficients() * num_vertices_;
    const uint64_t baked_per_channel = bake_.identity().layout.num_coefficients() * num_vertices_;
    const auto count = static_cast<uint64_t>(block.rows());
    for (uint32_t p = 0; p < num_columns(); ++p) {
        for (uint64_t done = 0; done < count;) {
            const uint64_t channel = (first + done) / kept_per_channel;
            const uint64_t within = (first + done) % kept_per_channel;
            const uint64_t piece = std::min(count - done, kept_per_channel - within);
            const uint64_t from = channel * baked_per_channel + within;
            float* const to = block.col(p).data() + done;
            if (content_ == Content::noise) {
                bake_.read_noise_rows(p, from, piece, to);
            } else {
                bake_.read_transfer_rows(p, from, piece, to);
            }
            done += piece;
        }
    }
}

PoseDiagonals pose_diagonals(const BakeReader& bake, const PositionOutliers& outliers,
                             const std::vector<uint32_t>& vertices) {
    std::vector<double> diagonals;
    const uint32_t num_vertices = bake.identity().num_vertices;
    const size_t num_sized = num_below(bake.identity().num_following, vertices);
    std::vector<float> positions;
    for (uint32_t p = 0; p < bake.num_poses(); ++p) {
        positions.resize(size_t{3} * num_vertices);
        bake.read_position_rows(p, 0, positions.size(), positions.data());
        outliers.replace(p, num_vertices, 0, positions);
        keep_vertices(positions, num_vertices, vertices);
        GeometryError pose;
        pose.add(positions, positions, p, num_sized);
        diagonals.push_back(pose.diagonal);
    }
    std::sort(diagonals.begin(), diagonals.end());
    return {diagonals.back(), diagonals[diagonals.size() / 2]};
}

}  // namespace paim
