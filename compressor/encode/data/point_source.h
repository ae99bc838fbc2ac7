// Points of many coordinates that are read plane by plane, so that they need never be in memory as
// a whole.
#pragma once

#include <Eigen/Core>

#include <cstdint>

#include "compressor/encode/data/row_source.h"
#include "paim/base/check.h"

namespace paim {

// Plane j holds num_columns() coordinates of every point; all planes side by side are the points'
// vectors of num_dimensions() values. Of a transfer the points are the vertices, a plane is a
// coefficient and its columns are the poses.
class PointSource {
  public:
    virtual ~PointSource() = default;

    virtual uint32_t num_points() const = 0;
    virtual uint32_t num_planes() const = 0;
    virtual uint32_t num_columns() const = 0;

    // Plane j into out [V][n]; finite values.
    virtual void read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const = 0;

    uint64_t num_dimensions() const { return uint64_t{num_planes()} * num_columns(); }
};

// A matrix [V][planes · n] in memory.
class MatrixPoints : public PointSource {
  public:
    MatrixPoints(const Eigen::MatrixXf& matrix, uint32_t num_planes)
        : matrix_(matrix), num_planes_(num_planes) {
        PAIM_CHECK(num_planes > 0 && matrix.cols() % num_planes == 0);
    }

    uint32_t num_points() const override { return static_cast<uint32_t>(matrix_.rows()); }
    uint32_t num_planes() const override { return num_planes_; }
    uint32_t num_columns() const override {
        return static_cast<uint32_t>(matrix_.cols()) / num_planes_;
    }
    void read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const override {
        out = matrix_.middleCols(static_cast<Eigen::Index>(plane) * num_columns(), num_columns());
    }

  private:
    const Eigen::MatrixXf& matrix_;
    uint32_t num_planes_;
};

// Rows that are plane-major, such as a bake's: row plane · V + v belongs to point v.
class RowPlanes : public PointSource {
  public:
    RowPlanes(const RowSource& rows, uint32_t num_planes) : rows_(rows), num_planes_(num_planes) {
        PAIM_CHECK(num_planes > 0 && rows.num_rows() % num_planes == 0);
    }

    uint32_t num_points() const override {
        return static_cast<uint32_t>(rows_.num_rows() / num_planes_);
    }
    uint32_t num_planes() const override { return num_planes_; }
    uint32_t num_columns() const override { return rows_.num_columns(); }
    // Copies by pieces, so that there is no second plane in memory.
    void read(uint32_t plane, Eigen::Ref<Eigen::MatrixXf> out) const override {
        constexpr Eigen::Index kPiece = 16384;
        const uint64_t first = uint64_t{plane} * num_points();
        Eigen::MatrixXf block;
        for (Eigen::Index row = 0; row < out.rows(); row += kPiece) {
            block.resize(std::min(kPiece, out.rows() - row), out.cols());
            rows_.read(first + static_cast<uint64_t>(row), block);
            out.middleRows(row, block.rows()) = block;
        }
    }

  private:
    const RowSource& rows_;
    uint32_t num_planes_;
};

}  // namespace paim
