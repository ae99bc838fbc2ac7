// The data matrices of a bake (E3), a column a pose; rows plane-major.
#pragma once

#include "compressor/encode/data/row_source.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// Rows (v, x|y|z).
class GeometryRows : public RowSource {
  public:
    explicit GeometryRows(const BakeReader& bake) : bake_(bake) {}

    uint64_t num_rows() const override { return uint64_t{3} * bake_.identity().num_vertices; }
    uint32_t num_columns() const override { return bake_.num_poses(); }
    void read(uint64_t first, Eigen::MatrixXf& block) const override;

  private:
    const BakeReader& bake_;
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

}  // namespace paim
