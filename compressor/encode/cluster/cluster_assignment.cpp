// Assigns points to the nearest affine subspace.
// Based on: Sloan, Hall, Hart and Snyder 2003; the cost of neighbours is the Potts model of Besag,
//           On the Statistical Analysis of Dirty Pictures, 1986 (iterated conditional modes)
#include <algorithm>
#include <limits>

#include "compressor/encode/cluster/cluster_subspaces.h"
#include "compressor/encode/cluster/point_projection.h"
#include "paim/base/check.h"
#include "paim/base/parallel.h"

namespace paim {

using Eigen::Index;
using Eigen::MatrixXf;

namespace {

// Products of so many columns with a block of points are in the cache together.
constexpr Index kColumnsAtOnce = 512;

class Assignment {
  public:
    Assignment(const MatrixXf& points, const ClusterSubspaces& subspaces)
        : points_(points), subspaces_(subspaces) {}

    // |x − m|² − |Bᵀ(x − m)|² less |x|² for the points of a block and all clusters:
    // [points][clusters]
    MatrixXf factors(Index first, Index count) const {
        const Index step = static_cast<Index>(subspaces_.num_components()) + 1;
        const Index num_clusters = static_cast<Index>(subspaces_.num_clusters());
        const Index at_once = std::max<Index>(1, kColumnsAtOnce / step);
        MatrixXf factors(count, num_clusters), products;
        const auto block = points_.middleCols(first, count);
        for (Index c = 0; c < num_clusters; c += at_once) {
            const Index some = std::min(at_once, num_clusters - c);
            products.noalias() =
                block.transpose() * subspaces_.columns().middleCols(c * step, some * step);
            for (Index j = 0; j < some; ++j) {
                const Index column = (c + j) * step;
                const auto& of_mean = subspaces_.products();
                auto score = factors.col(c + j).array();
                score = of_mean[column] - 2.0f * products.col(j * step).array();
                for (Index k = 1; k < step; ++k) {
                    score -= (products.col(j * step + k).array() - of_mean[column + k]).square();
                }
            }
        }
        return factors;
    }

  private:
    const MatrixXf& points_;
    const ClusterSubspaces& subspaces_;
};

// What a point that belongs to cluster c counts as its squared distance to it, d2 as measured.
float own_cost(const ClusterSubspaces& subspaces, uint32_t c,
               const Eigen::Ref<const Eigen::VectorXf>& x, float d2) {
    // With leverage 1 the distance is 0 but for rounding.
    constexpr float kMin = 1e-3f;
    return d2 / std::max(kMin, 1.0f - subspaces.leverage(c, x));
}

uint32_t degree(const PointGraph* graph, size_t v) {
    return graph->first[v + 1] - graph->first[v];
}

}  // namespace

uint64_t assignment_scratch_bytes(uint64_t num_clusters) {
    // Costs and their temporaries, and products with as many.
    return kPointsAtOnce * 2 * (num_clusters + uint64_t{kColumnsAtOnce}) * sizeof(float);
}

void assign_points(const MatrixXf& points, const ClusterSubspaces& subspaces, float neighbour_cost,
                   const PointGraph* graph, std::vector<uint32_t>& cluster,
                   std::vector<float>& squared_distance) {
    const auto num_points = static_cast<size_t>(points.cols());
    PAIM_CHECK(neighbour_cost == 0.0f || graph != nullptr);
    PAIM_CHECK_EQ(cluster.size(), num_points);
    squared_distance.resize(num_points);
    const Assignment assignment(points, subspaces);
    const std::vector<uint32_t> before = cluster;
    parallel_for(num_points, kPointsAtOnce, [&](size_t begin, size_t end) {
        const auto first = static_cast<Index>(begin);
        const auto count = static_cast<Index>(end - begin);
        MatrixXf costs = assignment.factors(first, count);
        std::vector<float> own(end - begin), least(end - begin);
        for (Index v = 0; v < count; ++v) {
            const size_t at = begin + static_cast<size_t>(v);
            const auto x = points.col(first + v);
            float& cost = costs(v, static_cast<Index>(before[at]));
            const float length2 = x.squaredNorm();
            const float d2 = std::max(0.0f, length2 + cost);
            cost = own_cost(subspaces, before[at], x, d2) - length2;
            own[static_cast<size_t>(v)] = d2;
            if (neighbour_cost == 0.0f) continue;
            for (uint32_t e = graph->first[at]; e < graph->first[at + 1]; ++e) {
                costs(v, static_cast<Index>(before[graph->neighbour[e]])) -= neighbour_cost;
            }
        }
        std::fill(least.begin(), least.end(), std::numeric_limits<float>::infinity());
        for (Index c = 0; c < costs.cols(); ++c) {
            for (Index v = 0; v < count; ++v) {
                if (costs(v, c) < least[static_cast<size_t>(v)]) {
                    least[static_cast<size_t>(v)] = costs(v, c);
                    cluster[begin + static_cast<size_t>(v)] = static_cast<uint32_t>(c);
                }
            }
        }
        for (Index v = 0; v < count; ++v) {
            const size_t at = begin + static_cast<size_t>(v);
            float d2 = own[static_cast<size_t>(v)];
            if (cluster[at] != before[at]) {
                d2 = points.col(first + v).squaredNorm() + least[static_cast<size_t>(v)];
                for (uint32_t e = 0; neighbour_cost != 0.0f && e < degree(graph, at); ++e) {
                    const uint32_t u = graph->neighbour[graph->first[at] + e];
                    if (before[u] == cluster[at]) d2 += neighbour_cost;
                }
            }
            squared_distance[at] = std::max(0.0f, d2);
        }
    });
}

}  // namespace paim
