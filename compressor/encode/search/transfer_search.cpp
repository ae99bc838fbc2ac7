// Ways to code the transfer that meet an error.
#include "compressor/encode/search/transfer_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "compressor/encode/memory/search_limits.h"
#include "compressor/encode/quantise/float_part.h"
#include "compressor/encode/search/matrix_cost.h"
#include "compressor/encode/search/part_search.h"
#include "compressor/encode/search/transfer_cost.h"

namespace paim {

namespace {

// Bytes of numbers and coefficients of clusters.
uint64_t stored_bytes(const VertexClusters& clusters, const PlanePredictor& vertices) {
    LowRankMatrix columns;  // as one section each
    columns.num_planes = 1;
    columns.mean = std::vector<int16_t>(clusters.cluster.begin(), clusters.cluster.end());
    columns.components = clusters.coefficients;
    return stored_bytes(columns, vertices, Effort::fast) + clusters.scales.size() * sizeof(float);
}

}  // namespace

std::shared_ptr<const ClusteredFactors> TransferCoding::make_bases(
    const EncodeProblem& problem) const {
    return std::make_shared<const ClusteredFactors>(cluster_bases(
        problem.transfer, problem.plane_weight, *clusters, candidate.cluster_components));
}

void TransferCoding::apply(const EncodeProblem& problem, Model& model) const {
    model.clusters = {};
    if (!is_integer(precision)) {
        model.transfer = float_part(problem.transfer, quantiser.num_components, precision);
    } else if (clusters) {
        ClusteredMatrix quantised =
            quantise_clusters(bases ? *bases : *make_bases(problem), quantiser);
        model.transfer = std::move(quantised.matrix);
        model.clusters = std::move(quantised.clusters);
    } else {
        model.transfer = quantise(problem.transfer, quantiser);
    }
}

TransferSearch::TransferSearch(const EncodeProblem& problem, const EncodeOptions& options,
                               const EncodeTarget& target)
    : problem_(problem), options_(options), target_(target), decode_cost_(target.decode_cost) {}

void TransferSearch::add_floats(double most_error, std::vector<TransferCoding>& codings) const {
    const std::vector<double> tails = tail_errors(problem_.transfer, problem_.plane_weight);
    uint32_t k = 0;
    while (k + 1 < tails.size() && tails[k] > most_error) ++k;
    TransferCoding coding;
    coding.precision = options_.precision;
    coding.quantiser = {1.0, k, problem_.plane_weight};
    const uint64_t value = options_.precision == Precision::f16 ? 2 : 4;
    coding.candidate.codec = "svd";
    coding.candidate.components = k;
    coding.candidate.multiply_adds = svd_cost(problem_.layout, k);
    coding.candidate.bytes = problem_.transfer.mean.size() * (4 + k * value) +
                             4 * uint64_t{k} * problem_.bake.num_poses();
    if (cheap_enough(coding.candidate.multiply_adds)) codings.push_back(std::move(coding));
}

void TransferSearch::add_svd(double most_error, std::vector<TransferCoding>& codings) const {
    uint32_t most = problem_.transfer.num_components();
    while (most > 0 && !cheap_enough(svd_cost(problem_.layout, most))) --most;
    if (!cheap_enough(svd_cost(problem_.layout, most))) return;
    for (PartChoice& choice : part_choices(problem_.transfer, problem_.plane_weight, most_error,
                                           most, problem_.predictor)) {
        TransferCoding coding;
        coding.quantiser = std::move(choice.quantiser);
        coding.candidate.codec = "svd";
        coding.candidate.components = choice.num_components;
        coding.candidate.multiply_adds = svd_cost(problem_.layout, choice.num_components);
        coding.candidate.bytes = choice.bytes;
        codings.push_back(std::move(coding));
    }
}

std::shared_ptr<const ClusteredPca> TransferSearch::clusters(uint32_t num_clusters,
                                                             uint32_t assumed_components) {
    std::shared_ptr<const ClusteredPca>& found = clusters_[{num_clusters, assumed_components}];
    if (found) return found;
    ClusteringOptions clustering;
    clustering.num_clusters = num_clusters;
    clustering.assumed_components = assumed_components;
    clustering.max_components = kMaxSearchedComponents;
    clustering.memory_bytes = problem_.spare_bytes - kept_bytes_;
    const FactorPoints points(problem_.transfer, problem_.plane_weight);
    found = std::make_shared<const ClusteredPca>(
        clustered_pca(points, clustering, nullptr, problem_.bake.directory().string()));
    return found;
}

// Bases may be larger than the factors, so that only one candidate's are kept: most often the chosen
// one's. Nothing but time depends on it.
void TransferSearch::keep_bases_of_best(std::vector<TransferCoding>& codings) {
    const TransferCoding* best = best_coding(codings, target_.preference, {});
    kept_bytes_ = 0;
    for (TransferCoding& coding : codings) {
        if (!coding.bases) continue;
        const uint64_t bytes = coding.bases->size_bytes();
        if (&coding == best && bytes <= problem_.unneeded_bytes) {
            kept_bytes_ = bytes;
        } else {
            coding.bases.reset();
        }
    }
}

void TransferSearch::add_clusters(uint32_t num_clusters, double most_error,
                                  std::vector<TransferCoding>& codings) {
    const double num_poses = problem_.bake.num_poses();
    const auto fewest = [&](const ClusteredPca& pca, double share) {
        uint32_t k = 0;
        while (k <= pca.num_components && num_poses * pca.squared_error(k) > share * most_error) {
            ++k;
        }
        return k;
    };
    // Points are assigned to subspaces of about as many components as will be kept.
    constexpr double kUsualShare = 0.6;
    uint32_t assumed = kFirstAssumedComponents;
    const uint32_t needed = fewest(*clusters(num_clusters, assumed), kUsualShare);
    if (needed > kMaxSearchedComponents) return;
    if (needed > assumed + assumed / 2) {
        assumed = kMaxAssumedComponents;
    } else if (needed <= assumed / 2) {
        assumed /= 2;
    }
    const std::shared_ptr<const ClusteredPca> pca = clusters(num_clusters, assumed);

    std::set<uint32_t> counts;
    for (const double share : {0.9, kUsualShare, 0.3}) counts.insert(fewest(*pca, share));
    for (const uint32_t count : counts) {
        if (count > kMaxSearchedComponents) continue;
        // With many more rows of bases than vertices, which cost less as they are, it is slow to find out
        // that nothing is gained; up to twice as many may still play faster.
        if (uint64_t{pca->num_clusters} * (count + 1) >
            2 * uint64_t{problem_.transfer.num_points}) {
            continue;
        }
        const uint32_t cost = cpca_cost(problem_.layout, pca->num_clusters, count);
        if (!cheap_enough(cost)) continue;
        TransferCoding coding;
        coding.clusters = pca;
        coding.candidate.cluster_components = count;
        coding.bases = coding.make_bases(problem_);
        coding.quantiser = {1.0, problem_.transfer.num_components(), problem_.plane_weight};
        coding.quantiser.step = largest_step(*coding.bases, coding.quantiser, most_error);
        if (coding.quantiser.step == 0.0) continue;
        const ClusteredMatrix quantised = quantise_clusters(*coding.bases, coding.quantiser);
        coding.candidate.codec = "cpca";
        coding.candidate.components = quantised.matrix.num_components;
        coding.candidate.clusters = pca->num_clusters;
        coding.candidate.multiply_adds = cost;
        coding.candidate.bytes = stored_bytes(quantised.matrix, PlanePredictor(), Effort::fast) +
                                 stored_bytes(quantised.clusters, problem_.predictor);
        codings.push_back(std::move(coding));
        keep_bases_of_best(codings);
    }
}

void TransferSearch::add_all_clusters(double most_error, std::vector<TransferCoding>& codings) {
    // Once more clusters have made files this much larger, they go on doing so.
    constexpr double kPastTheSmallest = 1.3;
    const auto most = static_cast<uint32_t>(most_clusters(problem_.transfer.num_points));
    const auto fewest_bytes = [&](size_t first) {
        uint64_t fewest = std::numeric_limits<uint64_t>::max();
        for (size_t j = first; j < codings.size(); ++j) {
            fewest = std::min(fewest, codings[j].candidate.bytes);
        }
        return static_cast<double>(fewest);
    };
    const size_t first = codings.size();
    uint32_t tried = 0;
    for (const uint32_t count : kClusterCounts) {
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
    kept_bytes_ = 0;
    if (!is_integer(options_.precision)) {
        add_floats(most_error, codings);
        return codings;
    }
    if (target_.codec != CodecChoice::cpca) add_svd(most_error, codings);
    if (target_.codec != CodecChoice::svd) {
        add_all_clusters(most_error, codings);
    }
    for (TransferCoding& coding : codings) coding.candidate.bands = problem_.layout.bands;
    return codings;
}

std::optional<uint32_t> TransferSearch::least_multiply_adds(double most_error) {
    decode_cost_.reset();
    const std::vector<TransferCoding> all = codings(most_error);
    decode_cost_ = target_.decode_cost;
    const auto cheapest =
        std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.candidate.multiply_adds < b.candidate.multiply_adds;
        });
    if (cheapest == all.end()) return std::nullopt;
    return cheapest->candidate.multiply_adds;
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
