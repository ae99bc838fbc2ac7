// Clustered principal component analysis: points in clusters, each with its own mean and its own
// few components.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003; Sattler, Sarlette and Klein, Simple and Efficient Compression of
//           Animation Sequences, 2005
#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "compressor/encode/cluster/clustering.h"
#include "compressor/encode/data/point_source.h"

namespace paim {

struct ClusteredPca {
    uint32_t num_clusters = 0;  // none of them empty
    uint32_t num_components = 0;
    std::vector<uint32_t> cluster;    // [V]
    std::vector<uint32_t> size;       // [clusters] points in each
    Eigen::MatrixXf coefficients;     // [V][K] unit RMS over each cluster, 0 beyond its rank
    Eigen::MatrixXd singular_values;  // [clusters][K] of the members about their mean
    std::vector<double> energy;       // [clusters] sum of squares of the members about their mean

    // Memory that it holds: coefficients of the points with their cluster, values of the clusters.
    static constexpr uint64_t held_bytes(uint64_t num_points, uint64_t num_clusters,
                                         uint64_t num_components) {
        return num_points * (num_components + 3) * sizeof(float) +
               num_clusters * (num_components + 3) * sizeof(double);
    }

    // Sum of squares of what num_components leave of all points, exactly what
    // for_each_basis_plane() gives back but for the rounding of floats.
    double squared_error(uint32_t num_components) const;
};

// The whole: projection, clustering, components. Deterministic, on any number of threads and within
// any memory.
// Error (unsupported) naming `what` if options.memory_bytes is not enough.
ClusteredPca clustered_pca(const PointSource& points, const ClusteringOptions& options,
                           const std::string& what = "clustered PCA");

// The same of points that are projected already, by project_points() to options.num_dimensions().
ClusteredPca clustered_pca(const PointSource& points, const Eigen::MatrixXf& projected,
                           const ClusteringOptions& options,
                           const std::string& what = "clustered PCA");

// The components of clusters that are known.
// projected  [d][V] where iterations start
ClusteredPca clustered_pca(const PointSource& points, const Eigen::MatrixXf& projected,
                           const Clustering& clustering, const ClusteringOptions& options);

// One pass over the planes, in order. rows [clusters (K + 1)][n]: row c (K + 1) is the mean of
// cluster c in this plane, row c (K + 1) + 1 + k its component k, so that
//   point v ≈ row c (K + 1) + Σ_k coefficients(v, k) · row c (K + 1) + 1 + k,  c = cluster[v]
// Component k is singular value / √size times the right singular vector. num_components at most
// pca.num_components.
void for_each_basis_plane(
    const PointSource& points, const ClusteredPca& pca, uint32_t num_components,
    const std::function<void(uint32_t plane, const Eigen::MatrixXf& rows)>& on_plane);

// The least memory that clustered_pca() needs, an upper bound for this many threads.
uint64_t clustered_pca_memory_bytes(const PointSource& points, const ClusteringOptions& options);

}  // namespace paim
