// How much memory clustered PCA takes, and what is left for Gram matrices.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/cluster/clustered_pca.h"

namespace paim {

// Memory that options.memory_bytes leaves for Gram matrices of clusters, at least for the largest.
uint64_t spare_gram_bytes(const PointSource& points, const ClusteringOptions& options);

// Error (unsupported) naming `what` and the memory that is needed if less is allowed.
void check_memory(const PointSource& points, const ClusteringOptions& options,
                  const std::string& what);

}  // namespace paim
