// How much memory clustered PCA takes.
#include "compressor/encode/cluster/clustered_pca_memory.h"

#include <algorithm>

#include "compressor/encode/cluster/cluster_grams.h"
#include "compressor/encode/cluster/point_projection.h"
#include "paim/base/error.h"
#include "paim/base/parallel.h"

namespace paim {

namespace {

constexpr uint64_t kFloat = sizeof(float), kDouble = sizeof(double);

// All below 2^32, their products of two below 2^64 with room for what they are multiplied by: points
// and dimensions of anything that can be read are far below 2^28.
struct Need {
    uint64_t points, columns, clusters, assumed, components, dimensions, sketch, threads;

    Need(const PointSource& source, const ClusteringOptions& options)
        : points(source.num_points()),
          columns(source.num_columns()),
          clusters(std::clamp<uint64_t>(options.num_clusters, 1, std::max<uint64_t>(1, points))),
          assumed(options.assumed_components),
          components(options.max_components),
          dimensions(std::min<uint64_t>(options.num_dimensions(), source.num_dimensions())),
          sketch(sketch_columns(options.num_dimensions(), source.num_dimensions())),
          threads(static_cast<uint64_t>(max_parallelism())) {}

    uint64_t plane() const { return points * columns * kFloat; }
    uint64_t projected() const { return points * dimensions * kFloat; }

    // The sketch while it is orthonormalised and narrowed, and its Gram matrix in parts.
    uint64_t projecting() const {
        return plane() + 2 * points * sketch * kFloat + 20 * sketch * sketch * kDouble +
               threads * 1024 * sketch * kFloat + (sketch + 2 * columns) * columns * kDouble;
    }

    // Subspaces; factors of the points that are at work; members and distances.
    uint64_t clustering() const {
        const uint64_t at_once = kPointsAtOnce * (2 * clusters + 1024) * kFloat;
        const uint64_t fitting = 1024 * (dimensions + assumed) * kFloat;
        return projected() + clusters * (assumed + 1) * (dimensions + 2) * kFloat + points * 24 +
               threads * std::max(at_once, fitting);
    }

    uint64_t gram() const {
        const uint64_t members = std::min<uint64_t>(points, kMaxGramMembers);
        return members * members * kDouble;
    }

    // The result (its vectors in double at first) and a plane; then what a thread has of a cluster:
    // gathered rows, the work space of its eigenvectors.
    uint64_t analysing() const {
        const uint64_t members = std::min<uint64_t>(points, kMaxGramMembers);
        const uint64_t iterated = components + std::max<uint64_t>(8, components / 2);
        const uint64_t result = points * components * (kFloat + kDouble) + points * 16 +
                                clusters * (components + 2) * kDouble;
        // Of a small cluster the matrix that is decomposed whole, of a larger one five blocks.
        const uint64_t eigenvectors =
            members * std::min(members, 6 * iterated) * kDouble + 3 * columns * kDouble;
        const uint64_t own = members * columns * kDouble + eigenvectors;
        // Q, G Q and their like of the points of large clusters; their start.
        const uint64_t large =
            points > kMaxGramMembers ? points * (4 * iterated + 2 * dimensions) * kDouble : 0;
        return projected() + plane() + result + threads * own + large;
    }

    // The allocator keeps some of what was freed: a quarter more.
    uint64_t total(uint64_t grams) const {
        return std::max({projecting(), clustering(), analysing() + grams}) / 4 * 5;
    }
};

}  // namespace

uint64_t clustered_pca_memory_bytes(const PointSource& points, const ClusteringOptions& options) {
    const Need need(points, options);
    return need.total(need.gram());
}

uint64_t spare_gram_bytes(const PointSource& points, const ClusteringOptions& options) {
    const Need need(points, options);
    const uint64_t beside = need.total(0);
    const uint64_t spare =
        options.memory_bytes > beside ? (options.memory_bytes - beside) / 5 * 4 : 0;
    return std::max(spare, need.gram());
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
