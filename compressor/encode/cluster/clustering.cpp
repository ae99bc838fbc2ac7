// The rounds of clustering: first about means, then about affine subspaces.
// Based on: Linde, Buzo and Gray 1980; Sloan, Hall, Hart and Snyder 2003 (see the header)
#include "compressor/encode/cluster/clustering.h"

#include <algorithm>

#include "compressor/encode/cluster/cluster_members.h"
#include "compressor/encode/cluster/cluster_seeding.h"
#include "compressor/encode/cluster/cluster_subspaces.h"

namespace paim {

namespace {

class Rounds {
  public:
    Rounds(const Eigen::MatrixXf& points, const ClusteringOptions& options, const PointGraph* graph)
        : points_(points),
          options_(options),
          graph_(options.coherence > 0.0f ? graph : nullptr),
          cluster_(static_cast<size_t>(points.cols()), 0) {}

    // Assigns points to the subspaces and fits those to them. False if no point moved.
    bool run(ClusterSubspaces& subspaces) {
        const std::vector<uint32_t> before = cluster_;
        assign_points(points_, subspaces, neighbour_cost(), graph_, cluster_, distance_);
        fill_empty_clusters(points_, distance_, subspaces.num_clusters(), cluster_);
        fit(subspaces);
        return before != cluster_;
    }

    void fit(ClusterSubspaces& subspaces) const {
        subspaces.fit(points_, ClusterMembers(cluster_, subspaces.num_clusters()), options_.seed);
    }

    Clustering result(uint32_t num_clusters) {
        num_clusters = drop_empty_clusters(num_clusters, cluster_);
        return {num_clusters, std::move(cluster_)};
    }

  private:
    // None in the first round, when nobody is anywhere yet.
    float neighbour_cost() const {
        if (graph_ == nullptr || distance_.empty()) return 0.0f;
        double sum = 0.0;
        for (const float d : distance_) sum += static_cast<double>(d);
        return options_.coherence * static_cast<float>(sum / static_cast<double>(distance_.size()));
    }

    const Eigen::MatrixXf& points_;
    const ClusteringOptions& options_;
    const PointGraph* graph_;
    std::vector<uint32_t> cluster_;  // [V]
    std::vector<float> distance_;    // [V] squared, of the last assignment
};

}  // namespace

Clustering cluster_points(const Eigen::MatrixXf& points, const ClusteringOptions& options,
                          const PointGraph* graph) {
    const auto num_clusters =
        static_cast<uint32_t>(std::clamp<Eigen::Index>(options.num_clusters, 1, points.cols()));
    ClusterSubspaces subspaces(points.rows(), num_clusters, 0);
    const std::vector<uint32_t> seeds = seed_clusters(points, num_clusters, options.seed);
    for (uint32_t c = 0; c < num_clusters; ++c) {
        // Where there are fewer seeds the first stands in: it loses every tie and stays empty.
        const uint32_t v = c < seeds.size() ? seeds[c] : seeds[0];
        subspaces.set_mean(c, points.col(static_cast<Eigen::Index>(v)));
    }
    Rounds rounds(points, options, graph);
    bool moved = rounds.run(subspaces);
    for (uint32_t round = 1; round < options.mean_rounds && moved; ++round) {
        moved = rounds.run(subspaces);
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
        moved = rounds.run(subspaces);
    }
    return rounds.result(num_clusters);
}

uint64_t clustering_scratch_bytes(uint64_t num_points, uint64_t num_dimensions,
                                  const ClusteringOptions& options, uint64_t num_threads) {
    // Of each point its cluster now and before, its distance, and its place among the members.
    constexpr uint64_t kBytesAPoint = 24;
    const uint64_t clusters =
        std::clamp<uint64_t>(options.num_clusters, 1, std::max<uint64_t>(1, num_points));
    const uint64_t at_work =
        std::max(assignment_scratch_bytes(clusters),
                 ClusterSubspaces::fit_scratch_bytes(num_dimensions, options.assumed_components));
    return ClusterSubspaces::held_bytes(num_dimensions, clusters, options.assumed_components) +
           num_points * kBytesAPoint + num_threads * at_work;
}

}  // namespace paim
