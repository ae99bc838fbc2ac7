// The first means of clusters: points that are spread out.
// Based on: Arthur and Vassilvitskii, k-means++: The Advantages of Careful Seeding, 2007
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace paim {

// Numbers of different points, at most num_clusters of them, each drawn with a probability
// proportional to its squared distance to those before; fewer if all others are equal to one of
// them. points [d][V]; only the first 32 coordinates count, the largest of a projection.
std::vector<uint32_t> seed_clusters(const Eigen::MatrixXf& points, uint32_t num_clusters,
                                    uint64_t seed);

}  // namespace paim
