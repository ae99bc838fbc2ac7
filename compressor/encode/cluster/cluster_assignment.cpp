// Assigns points to the nearest affine subspace, of all or of those of near clusters.
// Based on: Sloan, Hall, Hart and Snyder 2003
#include "compressor/encode/cluster/cluster_assignment.h"

#include <algorithm>
#include <limits>

#include "compressor/encode/cluster/point_projection.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

namespace {

// Products of so many columns with a block of points are in the cache together.
constexpr Index kColumnsAtOnce = 512;

// Squared distances of points to the affine subspaces of clusters, without the points' own |x|²:
// |x − m|² − |Bᵀ(x − m)|² − |x|².  [points][clusters]
// points    [d][n]
// clusters  which
MatrixXf costs_of(const MatrixXf& points, const ClusterSubspaces& subspaces,
                  std::span<const uint32_t> clusters) {
    const Index step = static_cast<Index>(subspaces.num_components()) + 1;
    const auto num_clusters = static_cast<Index>(clusters.size());
    const Index at_once = std::max<Index>(1, kColumnsAtOnce / step);
    MatrixXf costs(points.cols(), num_clusters), columns, products;
    for (Index first = 0; first < num_clusters; first += at_once) {
        const Index some = std::min(at_once, num_clusters - first);
        columns.resize(points.rows(), some * step);
        for (Index j = 0; j < some; ++j) {
            const auto c = static_cast<Index>(clusters[static_cast<size_t>(first + j)]);
            columns.middleCols(j * step, step) = subspaces.columns().middleCols(c * step, step);
        }
        products.noalias() = points.transpose() * columns;
        for (Index j = 0; j < some; ++j) {
            const auto c = static_cast<Index>(clusters[static_cast<size_t>(first + j)]);
            const auto of_mean = subspaces.products().segment(c * step, step);
            auto cost = costs.col(first + j).array();
            cost = of_mean[0] - 2.0f * products.col(j * step).array();
            for (Index k = 1; k < step; ++k) {
                cost -= (products.col(j * step + k).array() - of_mean[k]).square();
            }
        }
    }
    return costs;
}

// What a point that belongs to cluster c counts as its squared distance to it, d2 as measured.
float own_cost(const ClusterSubspaces& subspaces, uint32_t c,
               const Eigen::Ref<const Eigen::VectorXf>& x, float d2) {
    // With leverage 1 the distance is 0 but for rounding.
    constexpr float kMin = 1e-3f;
    return d2 / std::max(kMin, 1.0f - subspaces.leverage(c, x));
}

// Some members of one cluster.
struct Block {
    uint32_t cluster = 0;
    std::span<const uint32_t> members;
};

std::vector<Block> blocks_of(const ClusterMembers& members) {
    std::vector<Block> blocks;
    for (uint32_t c = 0; c < members.num_clusters(); ++c) {
        const auto all = members.of(c);
        for (size_t m = 0; m < all.size(); m += kPointsAtOnce) {
            blocks.push_back({c, all.subspan(m, std::min(kPointsAtOnce, all.size() - m))});
        }
    }
    return blocks;
}

}  // namespace

ClusterNeighbours::ClusterNeighbours(uint32_t num_clusters)
    : count_(num_clusters), neighbours_(num_clusters) {
    for (uint32_t c = 0; c < num_clusters; ++c) neighbours_[c] = c;
}

ClusterNeighbours::ClusterNeighbours(const ClusterSubspaces& subspaces, uint32_t count)
    : ClusterNeighbours(subspaces.num_clusters()) {
    if (subspaces.num_clusters() <= count) return;
    const std::vector<uint32_t> all = std::move(neighbours_);
    count_ = count;
    stride_ = count;
    neighbours_.resize(size_t{count} * all.size());
    const ClusterSubspaces means = subspaces.means();
    parallel_for(all.size(), kPointsAtOnce, [&](size_t begin, size_t end) {
        MatrixXf costs = costs_of(
            means.columns().middleCols(static_cast<Index>(begin), static_cast<Index>(end - begin)),
            subspaces, all);
        for (size_t c = begin; c < end; ++c) {
            const auto row = static_cast<Index>(c - begin);
            costs(row, static_cast<Index>(c)) = -std::numeric_limits<float>::infinity();
            std::vector<uint32_t> order = all;
            const auto nearer = [&](uint32_t a, uint32_t b) {
                const float cost_a = costs(row, a), cost_b = costs(row, b);
                return cost_a != cost_b ? cost_a < cost_b : a < b;
            };
            std::nth_element(order.begin(), order.begin() + count - 1, order.end(), nearer);
            std::sort(order.begin(), order.begin() + count);
            std::copy_n(order.begin(), count,
                        neighbours_.begin() + static_cast<std::ptrdiff_t>(c * count));
        }
    });
}

uint64_t assignment_scratch_bytes(uint64_t num_clusters, uint64_t num_dimensions) {
    // The points, costs and their temporaries, and columns and products of as many.
    return (kPointsAtOnce * (num_dimensions + 2 * (num_clusters + uint64_t{kColumnsAtOnce})) +
            num_dimensions * uint64_t{kColumnsAtOnce}) *
           sizeof(float);
}

void assign_points(const MatrixXf& points, const ClusterSubspaces& subspaces,
                   const ClusterNeighbours& neighbours, std::vector<uint32_t>& cluster,
                   std::vector<float>& squared_distance) {
    PAIM_CHECK_EQ(cluster.size(), static_cast<size_t>(points.cols()));
    squared_distance.resize(cluster.size());
    const ClusterMembers members(cluster, subspaces.num_clusters());
    const std::vector<Block> blocks = blocks_of(members);
    parallel_for(blocks.size(), 1, [&](size_t b, size_t) {
        const Block& block = blocks[b];
        const auto near = neighbours.of(block.cluster);
        const auto own = static_cast<Index>(
            std::lower_bound(near.begin(), near.end(), block.cluster) - near.begin());
        MatrixXf own_points(points.rows(), static_cast<Index>(block.members.size()));
        for (size_t m = 0; m < block.members.size(); ++m) {
            own_points.col(static_cast<Index>(m)) =
                points.col(static_cast<Index>(block.members[m]));
        }
        MatrixXf costs = costs_of(own_points, subspaces, near);
        for (Index m = 0; m < costs.rows(); ++m) {
            const uint32_t v = block.members[static_cast<size_t>(m)];
            const auto x = own_points.col(m);
            const float length2 = x.squaredNorm();
            const float d2 = std::max(0.0f, length2 + costs(m, own));
            costs(m, own) = own_cost(subspaces, block.cluster, x, d2) - length2;
            Index best = 0;
            const float least = costs.row(m).minCoeff(&best);
            cluster[v] = near[static_cast<size_t>(best)];
            squared_distance[v] = best == own ? d2 : std::max(0.0f, length2 + least);
        }
    });
}

}  // namespace paim
