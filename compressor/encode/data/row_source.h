// A data matrix that is read in blocks of rows, so that it need never be in memory as a whole.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <utility>

namespace paim {

class RowSource {
  public:
    virtual ~RowSource() = default;

    virtual uint64_t num_rows() const = 0;
    virtual uint32_t num_columns() const = 0;

    // Rows [first, first + block.rows()) into block, which has num_columns() columns. Thread-safe.
    virtual void read(uint64_t first, Eigen::MatrixXf& block) const = 0;

    // The same rows, for a pass that nobody counted on beforehand: it reports nothing.
    virtual const RowSource& silent() const { return *this; }
};

// Another source, with a word to the caller after each block that is read (from any thread).
class ReportingRows : public RowSource {
  public:
    ReportingRows(const RowSource& rows, std::function<void(uint64_t)> on_rows)
        : rows_(rows), on_rows_(std::move(on_rows)) {}

    uint64_t num_rows() const override { return rows_.num_rows(); }
    uint32_t num_columns() const override { return rows_.num_columns(); }
    void read(uint64_t first, Eigen::MatrixXf& block) const override {
        rows_.read(first, block);
        if (on_rows_) on_rows_(static_cast<uint64_t>(block.rows()));
    }
    const RowSource& silent() const override { return rows_; }

  private:
    const RowSource& rows_;
    std::function<void(uint64_t)> on_rows_;
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
