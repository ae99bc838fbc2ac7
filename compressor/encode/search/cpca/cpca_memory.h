// How far the search for clusters goes, and how much memory it takes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "compressor/encode/memory/target_memory.h"

namespace paim {

// With fewer vertices per cluster than this, the bases are as large as the vertices' own values.
constexpr uint32_t kMinPerCluster = 8;
// Numbers of clusters that are tried, if there are enough vertices for them.
constexpr std::array<uint32_t, 6> kClusterCounts{32, 64, 128, 256, 512, 1024};
// Components of the subspaces that vertices are assigned to: these, or half or twice as many if
// about that number of components will be kept.
constexpr uint32_t kUsualAssumedComponents = 8;
constexpr uint32_t kMaxAssumedComponents = 2 * kUsualAssumedComponents;
// Components of one cluster that are known: enough for those that will be kept.
constexpr uint32_t searched_components(uint32_t assumed) {
    return 2 * assumed;
}
constexpr uint32_t kMaxSearchedComponents = searched_components(kMaxAssumedComponents);
// Clusterings that are kept: one of each number of clusters.
constexpr uint32_t kMaxClusterings = kClusterCounts.size();

// The most clusters that are tried.
constexpr uint64_t most_clusters(uint64_t num_vertices) {
    return std::max<uint64_t>(1, num_vertices / kMinPerCluster);
}

// For sizes that target_memory_bytes() adds up, of which nothing overflows.
CodecMemory cpca_memory(const TargetSize& size);

}  // namespace paim
