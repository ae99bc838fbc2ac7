// What stands for clusters while points are assigned to them: affine subspaces.
// Based on: Kambhatla and Leen 1997; Sloan, Hall, Hart and Snyder 2003 (clustering.h)
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

#include "compressor/encode/cluster/cluster_members.h"

namespace paim {

// The mean of each cluster and an orthonormal basis of the directions in which its members spread.
class ClusterSubspaces {
  public:
    // d dimensions, K directions
    ClusterSubspaces(Eigen::Index num_dimensions, uint32_t num_clusters, uint32_t num_components);

    uint32_t num_clusters() const { return num_clusters_; }
    uint32_t num_components() const { return num_components_; }

    void set_mean(uint32_t c, const Eigen::VectorXf& mean);

    // The mean of the members, exactly, and their principal directions by a few steps of subspace
    // iteration that start where the last fit ended. A cluster has no more directions than its
    // members span; empty clusters stay as they were. seed keys the first start.
    void fit(const Eigen::MatrixXf& points, const ClusterMembers& members, uint64_t seed);

    // With room for more directions, which the next fit finds.
    ClusterSubspaces with_components(uint32_t num_components) const;

    // The means alone.
    ClusterSubspaces means() const;

    // From here to the next fit points are no members, so that their leverage is 0.
    void forget_members() { inverse_spread_.setZero(); }

    // How much of the cluster's own fit its member x is, 0 … 1, as the last fit left it:
    // 1/size + Σ_k (b_k · (x − mean))² / Σ over members. 0 before any fit.
    float leverage(uint32_t c, const Eigen::Ref<const Eigen::VectorXf>& x) const;

    // Memory that it holds for d dimensions and K directions.
    static constexpr uint64_t held_bytes(uint64_t num_dimensions, uint64_t num_clusters,
                                         uint64_t num_components) {
        return num_clusters * (num_components + 1) * (num_dimensions + 2) * sizeof(float);
    }
    // Memory of fit() on one thread.
    static uint64_t fit_scratch_bytes(uint64_t num_dimensions, uint64_t num_components);

    // Columns c (K + 1) + j: the mean (j = 0), then the directions; zero where there is none.
    const Eigen::MatrixXf& columns() const { return columns_; }
    // Products of each column with its cluster's mean.
    const Eigen::VectorXf& products() const { return products_; }

  private:
    void fit_cluster(const Eigen::MatrixXf& points, const ClusterMembers& members, size_t c,
                     uint64_t seed);

    uint32_t num_clusters_;
    uint32_t num_components_;
    Eigen::MatrixXf columns_;   // [d][clusters (K + 1)]
    Eigen::VectorXf products_;  // [clusters (K + 1)]
    // [clusters (K + 1)] 1 / size, then 1 / sum of squares along each direction; 0 where unknown
    Eigen::VectorXf inverse_spread_;
};

}  // namespace paim
