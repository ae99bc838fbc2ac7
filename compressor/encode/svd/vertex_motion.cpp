// How many components the motion of every single vertex needs.
#include "compressor/encode/svd/vertex_motion.h"

#include <algorithm>
#include <array>
#include <vector>

#include "compressor/encode/svd/tsqr.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;

namespace {

class MotionMeter {
  public:
    MotionMeter(const RowSource& rows, const PrincipalComponents& components,
                std::span<const uint32_t> vertices, const MotionLimits& limits)
        : rows_(rows),
          num_vertices_(rows.num_rows() / 3),
          vertices_(vertices),
          v_(components.v.leftCols(components.rank())),
          lost_energy_(limits.lost_share * limits.lost_share),
          invisible_energy_(limits.invisible * limits.invisible * rows.num_columns()) {}

    uint32_t run() {
        MatrixXd sum = MatrixXd::Zero(3, v_.rows());
        for_each_block([&](uint64_t first, uint64_t count) { add_up(first, count, sum); });
        MatrixXd centred;
        Eigen::VectorXd mean;
        const MatrixXf of_mesh = (sum / static_cast<double>(vertices_.size())).cast<float>();
        centre_rows(of_mesh, centred, mean);
        of_mesh_ = centred * v_;
        uint32_t most = 0;
        for_each_block(
            [&](uint64_t first, uint64_t count) { most = std::max(most, of_block(first, count)); });
        return most;
    }

  private:
    // Calls use(first, count) for vertices whose positions are in planes_.
    template <typename Use>
    void for_each_block(const Use& use) {
        // Three planes of so many rows are as large as a block of any other pass.
        const uint64_t at_once = std::max<uint64_t>(1, rows_per_block(rows_.num_columns()) / 3);
        for (uint64_t first = 0; first < num_vertices_; first += at_once) {
            const uint64_t count = std::min(at_once, num_vertices_ - first);
            for (uint64_t axis = 0; axis < 3; ++axis) {
                planes_[axis].resize(static_cast<Index>(count), v_.rows());
                rows_.read(axis * num_vertices_ + first, planes_[axis]);
            }
            use(first, count);
        }
    }

    // Those of vertices [begin, end) that count.
    std::span<const uint32_t> counted(uint64_t begin, uint64_t end) const {
        const auto from = std::lower_bound(vertices_.begin(), vertices_.end(), begin);
        return {from, std::lower_bound(from, vertices_.end(), end)};
    }

    // Adds positions of the vertices of each pose, [3][P].
    void add_up(uint64_t first, uint64_t count, MatrixXd& sum) const {
        for (const uint32_t v : counted(first, first + count)) {
            const auto row = static_cast<Index>(v - first);
            for (Index axis = 0; axis < 3; ++axis) {
                sum.row(axis) += planes_[static_cast<size_t>(axis)].row(row).cast<double>();
            }
        }
    }

    uint32_t of_block(uint64_t first, uint64_t count) const {
        std::vector<uint32_t> needed((count + kRowsAtOnce - 1) / kRowsAtOnce, 0);
        parallel_for(count, kRowsAtOnce, [&](size_t begin, size_t end) {
            needed[begin / kRowsAtOnce] = of_piece(first, begin, end - begin);
        });
        return *std::max_element(needed.begin(), needed.end());
    }

    // Of vertices first + row, …
    uint32_t of_piece(uint64_t first, size_t row, size_t count) const {
        MatrixXd centred, factors;
        Eigen::VectorXd mean;
        MatrixXd energy = MatrixXd::Zero(static_cast<Index>(count), v_.cols());
        Eigen::VectorXd within_mesh = Eigen::VectorXd::Zero(energy.rows());
        for (size_t axis = 0; axis < 3; ++axis) {
            centre_rows(planes_[axis].middleRows(static_cast<Index>(row), energy.rows()), centred,
                        mean);
            factors.noalias() = centred * v_;
            energy += factors.cwiseAbs2();
            // V is orthonormal.
            factors.rowwise() -= of_mesh_.row(static_cast<Index>(axis));
            within_mesh += factors.rowwise().squaredNorm();
        }
        const uint64_t begin = first + row;
        uint32_t most = 0;
        for (const uint32_t v : counted(begin, begin + count)) {
            const auto at = static_cast<Index>(v - begin);
            const double allowed = std::max(lost_energy_ * within_mesh[at], invisible_energy_);
            Index k = energy.cols();
            double dropped = 0.0;
            while (k > 0 && dropped + energy(at, k - 1) <= allowed) dropped += energy(at, --k);
            most = std::max(most, static_cast<uint32_t>(k));
        }
        return most;
    }

    const RowSource& rows_;
    const uint64_t num_vertices_;
    const std::span<const uint32_t> vertices_;
    const MatrixXd v_;  // [P][K]
    const double lost_energy_, invisible_energy_;
    MatrixXd of_mesh_;                // [3][K] factors of the mean of all vertices
    std::array<MatrixXf, 3> planes_;  // of the vertices at work
};

}  // namespace

uint32_t components_for_motion(const RowSource& rows, const PrincipalComponents& components,
                               std::span<const uint32_t> vertices, const MotionLimits& limits) {
    PAIM_CHECK_EQ(rows.num_rows() % 3, 0u);
    if (components.rank() == 0 || vertices.empty()) return 0;
    return MotionMeter(rows, components, vertices, limits).run();
}

uint64_t components_for_motion_bytes(uint64_t num_poses, uint64_t num_threads) {
    // V, and three planes of vertices as floats. On each thread centred rows, their factors, the sum
    // of their squares, and as much again for products.
    const uint64_t rows = rows_per_block(static_cast<uint32_t>(num_poses)) + 3;
    return num_poses * (num_poses * sizeof(double) + rows * sizeof(float) +
                        num_threads * 5 * static_cast<uint64_t>(kRowsAtOnce) * sizeof(double));
}

}  // namespace paim
