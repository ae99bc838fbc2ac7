// Assigns points to the nearest affine subspace, of all or of those of near clusters.
// Based on: Sloan, Hall, Hart and Snyder 2003 (clustering.h)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/encode/cluster/cluster_subspaces.h"

namespace paim {

// Of each cluster the clusters that its points may go to, itself among them.
class ClusterNeighbours {
  public:
    // All.
    explicit ClusterNeighbours(uint32_t num_clusters);
    // Those to whose subspaces its mean is nearest.
    ClusterNeighbours(const ClusterSubspaces& subspaces, uint32_t count);

    // In ascending order.
    std::span<const uint32_t> of(size_t c) const {
        return {neighbours_.data() + c * stride_, count_};
    }

    static constexpr uint64_t held_bytes(uint64_t num_clusters, uint64_t count) {
        return num_clusters * count * sizeof(uint32_t);
    }

  private:
    size_t count_, stride_ = 0;
    std::vector<uint32_t> neighbours_;
};

// Moves each point to the cluster whose subspace is nearest; of equals to the first. The squared
// distance to its own cluster counts 1/(1 − leverage) times: by that much the cluster's error falls
// when it leaves, for a fit always leans towards its own members (Hartigan and Wong, Algorithm AS
// 136: A K-Means Clustering Algorithm, 1979, where directions are none and leverage is 1/size; Cook
// and Weisberg, Residuals and Influence in Regression, 1982).
// cluster  [V] in: where they are; out: where they belong
// squared_distance [V] out: to that subspace
void assign_points(const Eigen::MatrixXf& points, const ClusterSubspaces& subspaces,
                   const ClusterNeighbours& neighbours, std::vector<uint32_t>& cluster,
                   std::vector<float>& squared_distance);

// Memory of assign_points() on one thread.
uint64_t assignment_scratch_bytes(uint64_t num_clusters, uint64_t num_dimensions);

}  // namespace paim
