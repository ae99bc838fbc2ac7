// How much memory clustered PCA takes.
#include "compressor/encode/cluster/clustered_pca_memory.h"

#include <algorithm>

#include "compressor/encode/cluster/cluster_grams.h"
#include "compressor/encode/cluster/point_projection.h"
#include "compressor/encode/memory_slack.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

// Of the largest cluster that is analysed by its Gram matrix.
uint64_t most_members(const PointSource& points, const ClusteringOptions& options) {
    return std::min(points.num_points(),
                    max_gram_members(points.num_dimensions(), options.max_components));
}

uint64_t largest_gram_bytes(const PointSource& points, const ClusteringOptions& options) {
    const uint64_t members = most_members(points, options);
    return members * members * sizeof(double);
}

// Points and dimensions of anything that can be read are far below 2^28, so that products of two of
// them and a factor stay below 2^64.
// gram_bytes  for the Gram matrices of clusters
uint64_t total_bytes(const PointSource& points, const ClusteringOptions& options,
                     uint64_t gram_bytes) {
    const uint64_t num_points = points.num_points(), columns = points.num_columns();
    const uint64_t components = options.max_components;
    const auto threads = static_cast<uint64_t>(max_parallelism());
    const uint64_t clusters =
        std::clamp<uint64_t>(options.num_clusters, 1, std::max<uint64_t>(1, num_points));
    const uint64_t dimensions =
        std::min<uint64_t>(options.num_dimensions(), points.num_dimensions());
    const uint64_t plane = num_points * columns * sizeof(float);
    const uint64_t projected = num_points * dimensions * sizeof(float);

    const uint64_t projecting = projection_scratch_bytes(points, options.num_dimensions(), threads);
    const uint64_t clustering =
        projected + clustering_scratch_bytes(num_points, dimensions, options, threads);
    // Vectors are doubles before they become coefficients; members are sorted by cluster.
    const uint64_t result = ClusteredPca::held_bytes(num_points, clusters, components) +
                            num_points * (components * sizeof(double) + sizeof(uint32_t));
    const uint64_t passes = num_points > most_members(points, options)
                                ? passes_scratch_bytes(num_points, dimensions, components)
                                : 0;
    const uint64_t analysing = projected + plane + result + gram_bytes + passes +
                               threads * gram_scratch_bytes(most_members(points, options), columns,
                                                            dimensions, components);
    return with_memory_slack(std::max({projecting, clustering, analysing}));
}

}  // namespace

uint64_t clustered_pca_memory_bytes(const PointSource& points, const ClusteringOptions& options) {
    return total_bytes(points, options, largest_gram_bytes(points, options));
}

uint64_t spare_gram_bytes(const PointSource& points, const ClusteringOptions& options) {
    const uint64_t others = total_bytes(points, options, 0);
    const uint64_t spare =
        options.memory_bytes > others ? without_memory_slack(options.memory_bytes - others) : 0;
    return std::max(spare, largest_gram_bytes(points, options));
}

void check_memory(const PointSource& points, const ClusteringOptions& options,
                  const std::string& what) {
    const uint64_t least = clustered_pca_memory_bytes(points, options);
    if (least > options.memory_bytes) {
        throw_unsupported(
            "{}: {} points of {} values in {} clusters of {} components need {} MB of memory, but "
            "{} MB are allowed",
            what, points.num_points(), points.num_dimensions(), options.num_clusters,
            options.max_components, least / 1'000'000 + 1, options.memory_bytes / 1'000'000);
    }
}

}  // namespace paim
