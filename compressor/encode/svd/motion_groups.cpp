// Groups of vertices that move together.
#include "compressor/encode/svd/motion_groups.h"

#include <Eigen/Core>

#include <algorithm>
#include <numeric>

#include "compressor/encode/svd/position_blocks.h"
#include "paim/mesh/face_vertices.h"
#include "paim/mesh/pieces.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr uint64_t kMostCompared = 256;

// The paths of the centres of small pieces, and their sizes.
class SmallPieces {
  public:
    // numbers  of the pieces
    SmallPieces(const Pieces& pieces, const std::vector<uint32_t>& numbers, const RowSource& rows)
        : slot_(pieces.count, kNone),
          centre_(MatrixXd::Zero(3 * static_cast<Index>(numbers.size()), rows.num_columns())),
          square_(numbers.size(), 0.0) {
        for (size_t j = 0; j < numbers.size(); ++j) slot_[numbers[j]] = static_cast<uint32_t>(j);
        PositionBlock block;
        for_each_position_block(rows, block, [&](uint64_t first, uint64_t count) {
            for (uint64_t v = 0; v < count; ++v) {
                const uint32_t slot = slot_[pieces.of_vertex[first + v]];
                if (slot != kNone) add(slot, block, static_cast<Index>(v));
            }
        });
        for (size_t j = 0; j < numbers.size(); ++j) {
            const double count = pieces.num_vertices[numbers[j]];
            auto centre = path(j);
            centre /= count;
            square_[j] = std::max(0.0, square_[j] / count - centre.squaredNorm()) /
                         static_cast<double>(centre.cols());
        }
    }

    bool move_together(size_t a, size_t b) const {
        MatrixXd between = path(a) - path(b);
        between.colwise() -= between.rowwise().mean().eval();
        const double mean_square = between.squaredNorm() / static_cast<double>(between.cols());
        return mean_square <= 4.0 * std::max(square_[a], square_[b]);
    }

  private:
    static constexpr uint32_t kNone = ~0u;

    Eigen::Block<MatrixXd> path(size_t j) {
        return centre_.block(3 * static_cast<Index>(j), 0, 3, centre_.cols());
    }
    Eigen::Block<const MatrixXd> path(size_t j) const {
        return centre_.block(3 * static_cast<Index>(j), 0, 3, centre_.cols());
    }

    void add(uint32_t slot, const PositionBlock& block, Index v) {
        for (Index axis = 0; axis < 3; ++axis) {
            const Eigen::RowVectorXd x = block[static_cast<size_t>(axis)].row(v).cast<double>();
            centre_.row(3 * static_cast<Index>(slot) + axis) += x;
            square_[slot] += x.squaredNorm();
        }
    }

    std::vector<uint32_t> slot_;  // by piece
    MatrixXd centre_;             // [3 · pieces][P]
    std::vector<double> square_;  // mean squared distance from the centre
};

}  // namespace

std::vector<uint32_t> motion_groups(const Topology& topology, const RowSource& rows) {
    constexpr uint64_t kShare = 20;
    const Pieces pieces = connected_pieces(topology);
    const size_t num_face_vertices = face_vertices(topology).size();
    std::vector<uint32_t> group_of(pieces.count, 0), small;
    uint32_t next = 1;
    for (uint32_t j = 0; j < pieces.count; ++j) {
        const uint32_t size = pieces.num_vertices[j];
        if (size < 2) continue;  // of no face
        if (kShare * size >= num_face_vertices) {
            group_of[j] = next++;
        } else {
            small.push_back(j);
        }
    }
    if (small.size() > 1) {
        std::stable_sort(small.begin(), small.end(), [&](uint32_t a, uint32_t b) {
            return pieces.num_vertices[a] > pieces.num_vertices[b];
        });
        small.resize(std::min<size_t>(small.size(), kMostCompared));
        const SmallPieces compared(pieces, small, rows);
        for (size_t j = 0; j < small.size(); ++j) {
            if (group_of[small[j]] != 0) continue;
            const uint32_t group = next++;
            group_of[small[j]] = group;
            for (size_t k = j + 1; k < small.size(); ++k) {
                if (group_of[small[k]] == 0 && compared.move_together(j, k)) {
                    group_of[small[k]] = group;
                }
            }
        }
    }
    std::vector<uint32_t> group(pieces.of_vertex.size());
    std::transform(pieces.of_vertex.begin(), pieces.of_vertex.end(), group.begin(),
                   [&](uint32_t piece) { return group_of[piece]; });
    return group;
}

uint64_t motion_groups_bytes(uint64_t num_vertices, uint64_t num_poses) {
    // Of each vertex its piece, group and number, twice while they are found; paths of pieces.
    return num_vertices * 5 * sizeof(uint32_t) +
           std::min(kMostCompared, num_vertices) * 3 * num_poses * sizeof(double);
}

}  // namespace paim
