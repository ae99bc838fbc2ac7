// How far the search for a coding of the transfer goes, and so how much memory it takes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace paim {

// Fewer vertices a cluster than this and the bases are as large as what they stand for.
constexpr uint32_t kMinPerCluster = 8;
// Numbers of clusters that are tried, as far as there are vertices for them.
constexpr std::array<uint32_t, 6> kClusterCounts{32, 64, 128, 256, 512, 1024};
// Of one cluster that are kept.
constexpr uint32_t kMaxSearchedComponents = 32;
// Of the subspaces that vertices are assigned to, at first; then half or twice as many, if about so
// many will be kept.
constexpr uint32_t kFirstAssumedComponents = 8;
constexpr uint32_t kMaxAssumedComponents = 2 * kFirstAssumedComponents;
// Clusterings that are kept: of each number of clusters at first and then.
constexpr uint32_t kMaxClusterings = 2 * kClusterCounts.size();

// The most clusters that are tried.
constexpr uint64_t most_clusters(uint64_t num_vertices) {
    return std::max<uint64_t>(1, num_vertices / kMinPerCluster);
}

}  // namespace paim
