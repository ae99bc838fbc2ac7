// The points of each cluster, and the splitting of clusters for the sake of empty ones.
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace paim {

class ClusterMembers {
  public:
    // cluster [V], all below num_clusters
    ClusterMembers(const std::vector<uint32_t>& cluster, uint32_t num_clusters);

    uint32_t num_clusters() const { return static_cast<uint32_t>(first_.size()) - 1; }
    uint32_t size(size_t c) const { return first_[c + 1] - first_[c]; }
    // In ascending order.
    std::span<const uint32_t> of(size_t c) const { return {member_.data() + first_[c], size(c)}; }

  private:
    std::vector<uint32_t> first_;   // [clusters + 1]
    std::vector<uint32_t> member_;  // [V]
};

// Gives every empty cluster a part of the one with the largest error, as long as that has different
// points. points [d][V]; squared_distance [V], of each point to what stands for its cluster.
// Returns how many are still empty.
uint32_t fill_empty_clusters(const Eigen::MatrixXf& points,
                             const std::vector<float>& squared_distance, uint32_t num_clusters,
                             std::vector<uint32_t>& cluster);

// Renumbers the clusters without the empty ones and returns how many there are.
uint32_t drop_empty_clusters(uint32_t num_clusters, std::vector<uint32_t>& cluster);

}  // namespace paim
