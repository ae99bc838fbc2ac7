// Ways to code the transfer that meet an error.
#include "compressor/encode/transfer_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "compressor/encode/float_part.h"
#include "compressor/encode/matrix_cost.h"
#include "compressor/encode/part_search.h"
#include "paim/metrics/rates.h"

namespace paim {

namespace {

constexpr uint32_t kMostClusterComponents = 32;

uint32_t svd_cost(const TransferLayout& layout, uint32_t num_components) {
    return static_cast<uint32_t>(svd_transfer_cost(layout, num_components, true).per_vertex());
}

uint32_t cpca_cost(const TransferLayout& layout, uint32_t num_clusters, uint32_t num_components) {
    return static_cast<uint32_t>(
        clustered_transfer_cost(layout, num_clusters, num_components, 0, true).per_vertex());
}

// Bytes of numbers and coefficients of clusters.
uint64_t stored_bytes(const VertexClusters& clusters, const PlanePredictor& vertices) {
    LowRankMatrix columns;  // as one section each
    columns.num_planes = 1;
    columns.mean = std::vector<int16_t>(clusters.cluster.begin(), clusters.cluster.end());
    columns.components = clusters.coefficients;
    return stored_bytes(columns, vertices, Effort::fast) + clusters.scales.size() * sizeof(float);
}

}  // namespace

void TransferCoding::apply(const Material& material, Model& model) const {
    model.clusters = {};
    if (!is_integer(precision)) {
        model.transfer = float_part(material.transfer, quantiser.num_components, precision);
    } else if (clusters) {
        ClusteredMatrix quantised =
            quantise_clusters(cluster_bases(material.transfer, material.plane_weight, *clusters,
                                            candidate.cluster_components),
                              quantiser);
        model.transfer = std::move(quantised.matrix);
        model.clusters = std::move(quantised.clusters);
    } else {
        model.transfer = quantise(material.transfer, quantiser);
    }
}

TransferSearch::TransferSearch(const Material& material, const EncodeOptions& options,
                               const EncodeTarget& target)
    : material_(material), options_(options), target_(target) {}

void TransferSearch::add_floats(double most_error, std::vector<TransferCoding>& codings) const {
    const std::vector<double> tails = tail_errors(material_.transfer, material_.plane_weight);
    uint32_t k = 0;
    while (k + 1 < tails.size() && tails[k] > most_error) ++k;
    TransferCoding coding;
    coding.precision = options_.precision;
    coding.quantiser = {1.0, k, material_.plane_weight};
    const uint64_t value = options_.precision == Precision::f16 ? 2 : 4;
    coding.candidate.codec = "svd";
    coding.candidate.components = k;
    coding.candidate.multiply_adds = svd_cost(material_.layout, k);
    coding.candidate.bytes = material_.transfer.mean.size() * (4 + k * value) +
                             4 * uint64_t{k} * material_.bake.num_poses();
    if (cheap_enough(coding.candidate.multiply_adds)) codings.push_back(std::move(coding));
}

void TransferSearch::add_svd(double most_error, std::vector<TransferCoding>& codings) const {
    uint32_t most = material_.transfer.num_components();
    while (most > 0 && !cheap_enough(svd_cost(material_.layout, most))) --most;
    if (!cheap_enough(svd_cost(material_.layout, most))) return;
    for (PartChoice& choice : part_choices(material_.transfer, material_.plane_weight, most_error,
                                           most, material_.predictor)) {
        TransferCoding coding;
        coding.quantiser = std::move(choice.quantiser);
        coding.candidate.codec = "svd";
        coding.candidate.components = choice.num_components;
        coding.candidate.multiply_adds = svd_cost(material_.layout, choice.num_components);
        coding.candidate.bytes = choice.bytes;
        codings.push_back(std::move(coding));
    }
}

const TransferSearch::Clusters& TransferSearch::clusters(uint32_t num_clusters,
                                                         uint32_t assumed_components) {
    Clusters& found = clusters_[{num_clusters, assumed_components}];
    if (found.pca) return found;
    ClusteringOptions clustering;
    clustering.num_clusters = num_clusters;
    clustering.assumed_components = assumed_components;
    clustering.max_components = kMostClusterComponents;
    clustering.memory_bytes = material_.spare_bytes;
    const ScorePoints points(material_.transfer, material_.plane_weight);
    found.pca = std::make_shared<const ClusteredPca>(
        clustered_pca(points, clustering, nullptr, material_.bake.directory().string()));
    return found;
}

void TransferSearch::add_clusters(uint32_t num_clusters, double most_error,
                                  std::vector<TransferCoding>& codings) {
    const double num_poses = material_.bake.num_poses();
    const auto fewest = [&](const ClusteredPca& pca, double share) {
        uint32_t k = 0;
        while (k <= pca.num_components && num_poses * pca.squared_error(k) > share * most_error) {
            ++k;
        }
        return k;
    };
    // Points are assigned to subspaces of about as many components as will be kept.
    constexpr uint32_t kFirstGuess = 8;
    constexpr double kUsualShare = 0.6;
    uint32_t assumed = kFirstGuess;
    const uint32_t needed = fewest(*clusters(num_clusters, assumed).pca, kUsualShare);
    if (needed > kMostClusterComponents) return;
    if (needed > kFirstGuess + kFirstGuess / 2) assumed = 2 * kFirstGuess;
    if (needed < kFirstGuess / 2 + 1) assumed = kFirstGuess / 2;
    const Clusters& chosen = clusters_[{num_clusters, (clusters(num_clusters, assumed), assumed)}];

    std::set<uint32_t> counts;
    for (const double share : {0.9, kUsualShare, 0.3}) counts.insert(fewest(*chosen.pca, share));
    for (const uint32_t count : counts) {
        if (count > kMostClusterComponents) continue;
        // With many more rows of bases than vertices, which cost less as they are, it is slow to find out
        // that nothing is gained; up to twice as many may still play faster.
        if (uint64_t{chosen.pca->num_clusters} * (count + 1) >
            2 * uint64_t{material_.transfer.num_points}) {
            continue;
        }
        const uint32_t cost = cpca_cost(material_.layout, chosen.pca->num_clusters, count);
        if (!cheap_enough(cost)) continue;
        // Made again whenever they are needed: they may be larger than the scores.
        const ClusteredScores clustered =
            cluster_bases(material_.transfer, material_.plane_weight, *chosen.pca, count);
        TransferCoding coding;
        coding.clusters = chosen.pca;
        coding.quantiser = {1.0, material_.transfer.num_components(), material_.plane_weight};
        coding.quantiser.step = largest_step(clustered, coding.quantiser, most_error);
        if (coding.quantiser.step == 0.0) continue;
        const ClusteredMatrix quantised = quantise_clusters(clustered, coding.quantiser);
        coding.candidate.codec = "cpca";
        coding.candidate.components = quantised.matrix.num_components;
        coding.candidate.clusters = chosen.pca->num_clusters;
        coding.candidate.cluster_components = count;
        coding.candidate.multiply_adds = cost;
        coding.candidate.bytes = stored_bytes(quantised.matrix, PlanePredictor(), Effort::fast) +
                                 stored_bytes(quantised.clusters, material_.predictor);
        codings.push_back(std::move(coding));
    }
}

void TransferSearch::add_all_clusters(double most_error, std::vector<TransferCoding>& codings) {
    // Fewer than some vertices a cluster and the bases are as large as what they stand for.
    constexpr uint32_t kLeastPerCluster = 8;
    constexpr std::array<uint32_t, 6> kCounts{32, 64, 128, 256, 512, 1024};
    // Once more clusters have made files this much larger, they go on doing so.
    constexpr double kPastTheSmallest = 1.3;
    const uint32_t most = std::max(1u, material_.transfer.num_points / kLeastPerCluster);
    const auto fewest_bytes = [&](size_t first) {
        uint64_t fewest = std::numeric_limits<uint64_t>::max();
        for (size_t j = first; j < codings.size(); ++j) {
            fewest = std::min(fewest, codings[j].candidate.bytes);
        }
        return static_cast<double>(fewest);
    };
    const size_t first = codings.size();
    uint32_t tried = 0;
    for (const uint32_t count : kCounts) {
        if (std::min(count, most) == tried) break;
        tried = std::min(count, most);
        const size_t before = codings.size();
        add_clusters(tried, most_error, codings);
        if (target_.preference == Preference::size && codings.size() > before &&
            fewest_bytes(before) > kPastTheSmallest * fewest_bytes(first)) {
            break;
        }
    }
}

std::vector<TransferCoding> TransferSearch::codings(double most_error) {
    std::vector<TransferCoding> codings;
    if (!is_integer(options_.precision)) {
        add_floats(most_error, codings);
        return codings;
    }
    if (target_.codec != CodecChoice::cpca) add_svd(most_error, codings);
    if (target_.codec != CodecChoice::svd) {
        add_all_clusters(most_error, codings);
    }
    for (TransferCoding& coding : codings) coding.candidate.bands = material_.layout.bands;
    return codings;
}

const TransferCoding* best_coding(const std::vector<TransferCoding>& codings, Preference preference,
                                  std::optional<uint64_t> most_bytes) {
    uint64_t limit = most_bytes.value_or(std::numeric_limits<uint64_t>::max());
    if (preference == Preference::size) {
        uint64_t fewest = limit;
        for (const TransferCoding& coding : codings) {
            fewest = std::min(fewest, coding.candidate.bytes);
        }
        limit = std::min(limit, fewest + fewest / 100);
    }
    const TransferCoding* best = nullptr;
    const auto cost = [](const TransferCoding& coding) {
        return std::pair(coding.candidate.multiply_adds, coding.candidate.bytes);
    };
    for (const TransferCoding& coding : codings) {
        if (coding.candidate.bytes > limit) continue;
        if (best == nullptr || cost(coding) < cost(*best)) best = &coding;
    }
    return best;
}

}  // namespace paim
