// A data matrix that is read in blocks of rows, so that it need never be in memory as a whole.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace paim {

class RowSource {
  public:
    virtual ~RowSource() = default;

    virtual uint64_t num_rows() const = 0;
    virtual uint32_t num_columns() const = 0;

    // Rows [first, first + block.rows()) into block, which has num_columns() columns. Thread-safe.
    virtual void read(uint64_t first, Eigen::MatrixXf& block) const = 0;
};

// A matrix in memory.
class MatrixRows : public RowSource {
  public:
    explicit MatrixRows(const Eigen::MatrixXf& matrix) : matrix_(matrix) {}

    uint64_t num_rows() const override { return static_cast<uint64_t>(matrix_.rows()); }
    uint32_t num_columns() const override { return static_cast<uint32_t>(matrix_.cols()); }
    void read(uint64_t first, Eigen::MatrixXf& block) const override {
        block = matrix_.middleRows(static_cast<Eigen::Index>(first), block.rows());
    }

  private:
    const Eigen::MatrixXf& matrix_;
};

}  // namespace paim
