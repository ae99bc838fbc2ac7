// Cuts points into clusters that few principal components each describe well.
// Based on: Linde, Buzo and Gray, An Algorithm for Vector Quantizer Design, 1980; Kambhatla and
//           Leen, Dimension Reduction by Local Principal Component Analysis, 1997; Sloan, Hall,
//           Hart and Snyder, Clustered Principal Components for Precomputed Radiance Transfer,
//           2003; Sattler, Sarlette and Klein, Simple and Efficient Compression of Animation
//           Sequences, 2005
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace paim {

struct ClusteringOptions {
    uint32_t num_clusters = 256;
    uint32_t assumed_components = 8;  // of the affine subspaces that points are assigned to
    uint32_t max_components = 8;      // of the result; more or fewer than assumed
    uint64_t seed = 1;
    uint32_t mean_rounds = 4;     // by distance to the clusters' means, at least 1
    uint32_t affine_rounds = 32;  // by distance to affine subspaces of 1 … assumed components
    uint32_t projection = 64;     // dimensions to cluster in, at least; see num_dimensions()
    uint64_t memory_bytes = 1'000'000'000;

    // Dimensions that points are projected to: twice the dimension of a cluster's subspace, because
    // points of different clusters differ in what lies outside the subspaces.
    uint32_t num_dimensions() const { return std::max(projection, 2 * assumed_components); }
};

struct Clustering {
    uint32_t num_clusters = 0;      // none of them empty
    std::vector<uint32_t> cluster;  // [V]
};

// Many points, more than 49,152 and 192 a cluster, are clustered by a sample of two thirds of that, and
// then join its clusters.
// points  [d][V], a column a point
// Fewer clusters than asked for come back if there are fewer different points. Subspaces take at
// most half of the d dimensions.
Clustering cluster_points(const Eigen::MatrixXf& points, const ClusteringOptions& options);

// The same with first means from elsewhere, and with the rounds over all points.
// means  [d][clusters], at least one, in place of options.num_clusters
Clustering cluster_points_from(const Eigen::MatrixXf& points, const Eigen::MatrixXf& means,
                               const ClusteringOptions& options);

// Memory of cluster_points() for points [d][V]: subspaces, numbers and distances of the points, the
// sample of many, and on each thread the points at work.
uint64_t clustering_scratch_bytes(uint64_t num_points, uint64_t num_dimensions,
                                  const ClusteringOptions& options, uint64_t num_threads);

}  // namespace paim
