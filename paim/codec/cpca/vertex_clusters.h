// The cluster of each vertex, and its coefficients in the basis of the cluster.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include <cstdint>
#include <vector>

#include "paim/codec/stored_values.h"

namespace paim {

constexpr uint32_t kMaxClusters = 32767;
constexpr uint32_t kMaxClusterComponents = 255;  // of one cluster

// The transfer of vertex v is a mean and a few components of its cluster:
//   t(v) = scales[c][0] · row(c, 0) + Σ_j coefficients[j][v] · scales[c][1 + j] · row(c, 1 + j),
// c being its cluster and row(c, i) row c · rows_per_cluster() + i of the bases.
struct VertexClusters {
    uint32_t num_clusters = 0;
    uint32_t num_components = 0;             // of a cluster, in addition to its mean
    std::vector<uint32_t> cluster;           // [V]
    std::vector<StoredValues> coefficients;  // [components] of [V]
    std::vector<float> scales;               // [clusters][1 + components]; row 0 is the mean

    uint32_t rows_per_cluster() const { return num_components + 1; }
    uint32_t num_rows() const { return num_clusters * rows_per_cluster(); }
};

}  // namespace paim
