// The data matrices of a bake (E3), a column a pose; rows plane-major.
#pragma once

#include <vector>

#include "compressor/encode/data/row_source.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/outliers.h"

namespace paim {

// Rows (v, x|y|z), outliers where they usually are.
class GeometryRows : public RowSource {
  public:
    // Keeps references.
    GeometryRows(const BakeReader& bake, const PositionOutliers& outliers)
        : bake_(bake), outliers_(outliers) {}

    uint64_t num_rows() const override { return uint64_t{3} * bake_.identity().num_vertices; }
    uint32_t num_columns() const override { return bake_.num_poses(); }
    void read(uint64_t first, Eigen::MatrixXf& block) const override;

  private:
    const BakeReader& bake_;
    const PositionOutliers& outliers_;
};

// Rows (v, i[, channel]) of the first bands.
class TransferRows : public RowSource {
  public:
    // The transfer itself, or its noise (BakedPose::noise).
    enum class Content { transfer, noise };

    // bands 1 … the bake's
    TransferRows(const BakeReader& bake, uint32_t bands, Content content = Content::transfer);

    uint64_t num_rows() const override { return layout_.num_planes() * num_vertices_; }
    uint32_t num_columns() const override { return bake_.num_poses(); }
    void read(uint64_t first, Eigen::MatrixXf& block) const override;

  private:
    const BakeReader& bake_;
    Content content_;
    TransferLayout layout_;  // with the bands that are kept
    uint64_t num_vertices_;
};

// Diagonals of the bounding boxes of the poses, of these vertices, without outliers. Scene units.
struct PoseDiagonals {
    double largest = 0.0;
    double median = 0.0;
};
PoseDiagonals pose_diagonals(const BakeReader& bake, const PositionOutliers& outliers,
                             const std::vector<uint32_t>& vertices);

}  // namespace paim
