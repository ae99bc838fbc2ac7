// The rounds of clustering: first about means, then about affine subspaces.
// Based on: Linde, Buzo and Gray 1980; Sloan, Hall, Hart and Snyder 2003 (see the header)
#include "compressor/encode/cluster/clustering.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/cluster/cluster_assignment.h"
#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/cluster_seeding.h"
#include "compressor/encode/cluster/cluster_subspaces.h"
#include "paim/base/check.h"
#include "paim/base/seed.h"

namespace paim {

namespace {

// After the first round points move between near clusters alone; which those are is found again every
// so many affine rounds. docs/results/clusters.md has what fewer and more give.
constexpr uint32_t kNumNeighbours = 32;
constexpr uint64_t kRoundsANeighbourhood = 4;

class Rounds {
  public:
    Rounds(const Eigen::MatrixXf& points, uint64_t seed)
        : points_(points), seed_(seed), cluster_(static_cast<size_t>(points.cols()), 0) {}

    // Assigns points to the subspaces and fits those to them. False if no point moved.
    bool run(ClusterSubspaces& subspaces, const ClusterNeighbours& neighbours) {
        const std::vector<uint32_t> before = cluster_;
        assign_points(points_, subspaces, neighbours, cluster_, distance_);
        fill_empty_clusters(points_, distance_, subspaces.num_clusters(), cluster_);
        fit(subspaces);
        return before != cluster_;
    }

    void fit(ClusterSubspaces& subspaces) const {
        subspaces.fit(points_, ClusterMembers(cluster_, subspaces.num_clusters()), seed_);
    }

    Clustering result(uint32_t num_clusters) {
        num_clusters = drop_empty_clusters(num_clusters, cluster_);
        return {num_clusters, std::move(cluster_)};
    }

  private:
    const Eigen::MatrixXf& points_;
    const uint64_t seed_;
    std::vector<uint32_t> cluster_;  // [V]
    std::vector<float> distance_;    // [V] squared, of the last assignment
};

// The first means of subspaces.
ClusterSubspaces seed_subspaces(const Eigen::MatrixXf& points, uint32_t num_clusters,
                                uint64_t seed) {
    ClusterSubspaces subspaces(points.rows(), num_clusters, 0);
    const std::vector<uint32_t> seeds = seed_clusters(points, num_clusters, seed);
    for (uint32_t c = 0; c < num_clusters; ++c) {
        // Where there are fewer seeds the first stands in: it loses every tie and stays empty.
        const uint32_t v = c < seeds.size() ? seeds[c] : seeds[0];
        subspaces.set_mean(c, points.col(static_cast<Eigen::Index>(v)));
    }
    return subspaces;
}

// Subspaces that grow from means to all components while points move between them.
ClusterSubspaces find_subspaces(const Eigen::MatrixXf& points, const ClusteringOptions& options,
                                ClusterSubspaces subspaces, Rounds& rounds) {
    ClusterNeighbours neighbours(subspaces.num_clusters());
    bool moved = rounds.run(subspaces, neighbours);
    for (uint32_t round = 1; round < options.mean_rounds && moved; ++round) {
        if (round == 1) neighbours = ClusterNeighbours(subspaces, kNumNeighbours);
        moved = rounds.run(subspaces, neighbours);
    }
    const uint64_t most = std::min<uint64_t>(options.assumed_components,
                                             static_cast<uint64_t>(points.rows() + 1) / 2);
    for (uint64_t round = 0; round < options.affine_rounds && most > 0; ++round) {
        // From 1 to all, evenly over the rounds.
        const auto components = static_cast<uint32_t>(1 + round * most / options.affine_rounds);
        if (components > subspaces.num_components()) {
            subspaces = subspaces.with_components(components);
            rounds.fit(subspaces);
        } else if (!moved && components == most) {
            break;
        }
        if (round % kRoundsANeighbourhood == 0) {
            neighbours = ClusterNeighbours(subspaces, kNumNeighbours);
        }
        moved = rounds.run(subspaces, neighbours);
    }
    return subspaces;
}

// Of many points so many are enough to find the clusters; the others then join them.
size_t num_sampled(size_t num_points, uint32_t num_clusters) {
    constexpr size_t kFewest = 32768, kPerCluster = 128;
    const size_t enough = std::max(kFewest, kPerCluster * num_clusters);
    return num_points > enough + enough / 2 ? enough : num_points;
}

// One point at random of each of `count` pieces.
Eigen::MatrixXf sample(const Eigen::MatrixXf& points, size_t count, uint64_t seed) {
    const auto num_points = static_cast<uint64_t>(points.cols());
    Eigen::MatrixXf some(points.rows(), static_cast<Eigen::Index>(count));
    for (size_t n = 0; n < count; ++n) {
        const uint64_t first = n * num_points / count, end = (n + 1) * num_points / count;
        some.col(static_cast<Eigen::Index>(n)) = points.col(
            static_cast<Eigen::Index>(first + stream_key(seed, n, count) % (end - first)));
    }
    return some;
}

// Moves all points to the clusters of some, first to the nearest mean.
void join(ClusterSubspaces& subspaces, Rounds& rounds) {
    constexpr int kRounds = 6;
    ClusterSubspaces means = subspaces.means();
    rounds.run(means, ClusterNeighbours(means.num_clusters()));
    subspaces.forget_members();
    for (int round = 0; round < kRounds; ++round) {
        rounds.run(subspaces, ClusterNeighbours(subspaces, kNumNeighbours));
    }
}

}  // namespace

Clustering cluster_points(const Eigen::MatrixXf& points, const ClusteringOptions& options) {
    const auto num_points = static_cast<size_t>(points.cols());
    const auto num_clusters =
        static_cast<uint32_t>(std::clamp<size_t>(options.num_clusters, 1, num_points));
    Rounds rounds(points, options.seed);
    const size_t count = num_sampled(num_points, num_clusters);
    if (count == num_points) {
        find_subspaces(points, options, seed_subspaces(points, num_clusters, options.seed), rounds);
    } else {
        const Eigen::MatrixXf some = sample(points, count, options.seed);
        Rounds rounds_of_some(some, options.seed);
        ClusterSubspaces subspaces = find_subspaces(
            some, options, seed_subspaces(some, num_clusters, options.seed), rounds_of_some);
        join(subspaces, rounds);
    }
    return rounds.result(num_clusters);
}

Clustering cluster_points_from(const Eigen::MatrixXf& points, const Eigen::MatrixXf& means,
                               const ClusteringOptions& options) {
    PAIM_CHECK_EQ(means.rows(), points.rows());
    PAIM_CHECK_LT(0, means.cols());
    ClusterSubspaces subspaces(points.rows(), static_cast<uint32_t>(means.cols()), 0);
    for (uint32_t c = 0; c < subspaces.num_clusters(); ++c) {
        subspaces.set_mean(c, means.col(static_cast<Eigen::Index>(c)));
    }
    Rounds rounds(points, options.seed);
    find_subspaces(points, options, std::move(subspaces), rounds);
    return rounds.result(static_cast<uint32_t>(means.cols()));
}

uint64_t clustering_scratch_bytes(uint64_t num_points, uint64_t num_dimensions,
                                  const ClusteringOptions& options, uint64_t num_threads) {
    // Of each point its cluster now and before, its distance, and its place among the members.
    constexpr uint64_t kBytesAPoint = 24;
    const uint64_t clusters =
        std::clamp<uint64_t>(options.num_clusters, 1, std::max<uint64_t>(1, num_points));
    const uint64_t at_work =
        std::max(assignment_scratch_bytes(clusters, num_dimensions),
                 ClusterSubspaces::fit_scratch_bytes(num_dimensions, options.assumed_components));
    const uint64_t sampled = num_sampled(num_points, static_cast<uint32_t>(clusters));
    return ClusterSubspaces::held_bytes(num_dimensions, clusters, options.assumed_components) +
           ClusterNeighbours::held_bytes(clusters, kNumNeighbours) + num_points * kBytesAPoint +
           (sampled < num_points ? sampled * (kBytesAPoint + num_dimensions * sizeof(float)) : 0) +
           num_threads * at_work;
}

}  // namespace paim
