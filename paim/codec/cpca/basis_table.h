// Weighted sums of rows of clusters' bases: each vertex sums rows of its cluster, in all planes at
// once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "paim/base/line_allocator.h"
#include "paim/codec/cpca/vertex_clusters.h"
#include "paim/codec/stored_values.h"
#include "paim/codec/vector_unit.h"

namespace paim {

// Bases of clusters as weighted_sum() reads them: rows of padded planes.
struct BasisTable {
    uint32_t num_planes = 0;
    uint32_t padded_planes = 0;
    // [rows][padded planes], from the start of a cache line: vectors that straddle two lines cost
    // twice
    std::vector<float, LineAllocator<float>> values;

    // Sets the table to rows times their scales. Reuses its memory.
    // rows    [planes][R]
    // scales  [R]
    void assign(std::span<const float> rows, std::span<const float> scales);
};

// The rows and coefficients that vertices are sums of.
struct BasisSum {
    const BasisTable& table;
    std::span<const uint32_t> cluster;           // [V]
    std::span<const StoredValues> coefficients;  // [components] of [V]
    uint32_t rows_per_cluster;                   // at least 1 + components
};

// Writes vertex v of [first, first + count) in every plane to out[plane · V + v], with
// V = cluster.size():
//   (row(v, 0) + coefficients[0][v] · row(v, 1)) + coefficients[1][v] · row(v, 2) …
// where row(v, j) is row cluster[v] · rows_per_cluster + j of the table.
void weighted_sum(const BasisSum& combination, size_t first, size_t count, std::span<float> out,
                  VectorUnit unit = best_vector_unit());

// The values of all vertices in every plane of the table, with the first num_components components
// of each cluster, on all threads.
// out  [planes][V]
void sum_all(const VertexClusters& clusters, const BasisTable& table, uint32_t num_components,
             std::span<float> out);

}  // namespace paim
