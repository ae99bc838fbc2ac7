// How many components the motion of every single vertex needs.
#include "compressor/encode/svd/vertex_motion.h"

#include <algorithm>
#include <vector>

#include "compressor/encode/noise/rank_selection.h"
#include "compressor/encode/svd/position_blocks.h"
#include "compressor/encode/svd/tsqr.h"
#include "paim/base/check.h"
#include "paim/base/median.h"
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
          vertices_(vertices),
          v_(components.v.leftCols(components.rank())),
          group_(limits.group),
          num_groups_(group_.empty() ? 1 : 1 + *std::max_element(group_.begin(), group_.end())),
          lost_energy_(limits.lost_share * limits.lost_share),
          invisible_energy_(limits.invisible * limits.invisible * rows.num_columns()) {}

    uint32_t run() {
        find_means();
        uint32_t most = 0;
        for_each_block(
            [&](uint64_t first, uint64_t count) { most = std::max(most, of_block(first, count)); });
        return most;
    }

  private:
    // Calls use(first, count) for vertices whose positions are in planes_.
    template <typename Use>
    void for_each_block(const Use& use) {
        for_each_position_block(rows_, planes_, use);
    }

    // Those of vertices [begin, end) that count.
    std::span<const uint32_t> counted(uint64_t begin, uint64_t end) const {
        const auto from = std::lower_bound(vertices_.begin(), vertices_.end(), begin);
        return {from, std::lower_bound(from, vertices_.end(), end)};
    }

    uint32_t group_of(uint32_t v) const { return group_.empty() ? 0 : group_[v]; }

    // The motion of a vertex of the block: squared distances from its mean over the poses.
    double motion_energy(uint64_t first, uint32_t v) const {
        double energy = 0.0;
        for (const MatrixXf& plane : planes_) {
            const Eigen::RowVectorXd x = plane.row(static_cast<Index>(v - first)).cast<double>();
            energy += (x.array() - x.mean()).matrix().squaredNorm();
        }
        return energy;
    }

    // Of the vertices of each group that do not move much farther than the median vertex.
    void find_means() {
        std::vector<double> energies;
        energies.reserve(vertices_.size());
        for_each_block([&](uint64_t first, uint64_t count) {
            for (const uint32_t v : counted(first, first + count)) {
                energies.push_back(motion_energy(first, v));
            }
        });
        constexpr double kFar = 100.0;
        const double most = kFar * kFar * std::max(median(energies), invisible_energy_);
        MatrixXd sums = MatrixXd::Zero(3 * num_groups_, v_.rows());
        std::vector<double> counts(num_groups_, 0.0);
        size_t j = 0;
        for_each_block([&](uint64_t first, uint64_t count) {
            for (const uint32_t v : counted(first, first + count)) {
                if (energies[j++] > most) continue;
                ++counts[group_of(v)];
                for (Index axis = 0; axis < 3; ++axis) {
                    sums.row(3 * group_of(v) + axis) += planes_[static_cast<size_t>(axis)]
                                                            .row(static_cast<Index>(v - first))
                                                            .cast<double>();
                }
            }
        });
        for (uint32_t g = 0; g < num_groups_; ++g) {
            sums.middleRows(3 * g, 3) /= std::max(1.0, counts[g]);
        }
        MatrixXd centred;
        Eigen::VectorXd mean;
        centre_rows(sums.cast<float>(), centred, mean);
        of_group_ = centred * v_;
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
        Eigen::VectorXd within_group = Eigen::VectorXd::Zero(energy.rows());
        for (size_t axis = 0; axis < 3; ++axis) {
            centre_rows(planes_[axis].middleRows(static_cast<Index>(row), energy.rows()), centred,
                        mean);
            factors.noalias() = centred * v_;
            energy += factors.cwiseAbs2();
            // V is orthonormal.
            for (Index v = 0; v < factors.rows(); ++v) {
                const uint32_t group =
                    group_of(static_cast<uint32_t>(first + row) + static_cast<uint32_t>(v));
                within_group[v] +=
                    (factors.row(v) - of_group_.row(3 * group + static_cast<Index>(axis)))
                        .squaredNorm();
            }
        }
        const uint64_t begin = first + row;
        uint32_t most = 0;
        for (const uint32_t v : counted(begin, begin + count)) {
            const auto at = static_cast<Index>(v - begin);
            const double allowed = std::max(lost_energy_ * within_group[at], invisible_energy_);
            const auto energy_of = [&](uint32_t k) { return energy(at, static_cast<Index>(k)); };
            most = std::max(
                most, components_for(static_cast<uint32_t>(energy.cols()), allowed, energy_of));
        }
        return most;
    }

    const RowSource& rows_;
    const std::span<const uint32_t> vertices_;
    const MatrixXd v_;  // [P][K]
    const std::vector<uint32_t>& group_;
    const uint32_t num_groups_;
    const double lost_energy_, invisible_energy_;
    MatrixXd of_group_;     // [groups][3][K] factors of the mean of each group
    PositionBlock planes_;  // of the vertices at work
};

}  // namespace

uint32_t components_for_motion(const RowSource& rows, const PrincipalComponents& components,
                               std::span<const uint32_t> vertices, const MotionLimits& limits) {
    PAIM_CHECK_EQ(rows.num_rows() % 3, 0u);
    if (components.rank() == 0 || vertices.empty()) return 0;
    return MotionMeter(rows, components, vertices, limits).run();
}

uint64_t components_for_motion_bytes(uint64_t num_vertices, uint64_t num_poses,
                                     uint64_t num_threads) {
    // V, and three planes of vertices as floats. On each thread centred rows, their factors, the sum
    // of their squares, and as much again for products.
    const uint64_t rows = rows_per_block(static_cast<uint32_t>(num_poses)) + 3;
    // Of each vertex its energy, twice, and its group.
    const uint64_t of_vertices = num_vertices * (2 * sizeof(double) + sizeof(uint32_t));
    return of_vertices +
           num_poses * (num_poses * sizeof(double) + rows * sizeof(float) +
                        num_threads * 5 * static_cast<uint64_t>(kRowsAtOnce) * sizeof(double));
}

}  // namespace paim
