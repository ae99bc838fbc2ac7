// Codec cpca in the search.
#include "compressor/encode/search/cpca/cpca_encoder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "compressor/encode/search/cpca/clustered_quantise.h"
#include "compressor/encode/search/cpca/cpca_memory.h"
#include "compressor/encode/search/matrix_cost.h"
#include "paim/codec/cpca/cpca_transfer.h"

namespace paim {

namespace {

// Bytes of numbers and coefficients of clusters.
uint64_t stored_bytes(const VertexClusters& clusters, const PlanePredictor& vertices) {
    LowRank columns;  // as one section each
    columns.num_planes = 1;
    columns.mean = std::vector<int16_t>(clusters.cluster.begin(), clusters.cluster.end());
    columns.components = clusters.coefficients;
    return stored_bytes(columns, vertices, Effort::fast) + clusters.scales.size() * sizeof(float);
}

// As CpcaTransfer::numbers() has them.
constexpr const char* kClusters = "clusters";
constexpr const char* kClusterComponents = "cluster_components";

class CpcaSettings : public CodecSettings {
  public:
    CpcaSettings(std::shared_ptr<const ClusteredPca> clusters, uint32_t num_components)
        : clusters_(std::move(clusters)), num_components_(num_components) {}

    ClusteredFactors make_bases(const EncodeProblem& problem) const {
        return cluster_bases(problem.transfer, problem.plane_weight, *clusters_, num_components_);
    }
    // Bases are made twice unless they are held: once to compare, once to code.
    void hold(ClusteredFactors bases) {
        bases_ = std::make_unique<const ClusteredFactors>(std::move(bases));
    }
    const ClusteredFactors& held() const { return *bases_; }

    CodedTransfer code(const EncodeProblem& problem, const Quantiser& quantiser,
                       Precision /*integers*/) const override {
        ClusteredMatrix quantised = bases_ ? quantise_clusters(*bases_, quantiser)
                                           : quantise_clusters(make_bases(problem), quantiser);
        return CpcaTransfer(std::move(quantised.matrix), std::move(quantised.clusters));
    }
    double squared_error(const EncodeProblem& problem, const Quantiser& quantiser) const override {
        return bases_ ? clustered_error(*bases_, quantiser)
                      : clustered_error(make_bases(problem), quantiser);
    }
    uint64_t held_bytes() const override { return bases_ ? bases_->size_bytes() : 0; }
    void release() override { bases_.reset(); }

  private:
    std::shared_ptr<const ClusteredPca> clusters_;
    uint32_t num_components_;
    std::unique_ptr<const ClusteredFactors> bases_;
};

class CpcaEncoder : public TransferEncoder {
  public:
    explicit CpcaEncoder(const TransferSearchTask& task) : task_(task), problem_(task.problem) {}

    void add_codings(double most_error, std::optional<uint32_t> decode_cost,
                     std::vector<TransferCoding>& codings) override {
        kept_bytes_ = 0;
        decode_cost_ = decode_cost;
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
            if (task_.target.preference == Preference::size && codings.size() > before &&
                fewest_bytes(before) > kPastTheSmallest * fewest_bytes(first)) {
                break;
            }
        }
    }

  private:
    std::shared_ptr<const ClusteredPca> clusters(uint32_t num_clusters,
                                                 uint32_t subspace_dimension) {
        std::shared_ptr<const ClusteredPca>& found = clusters_[{num_clusters, subspace_dimension}];
        if (found) return found;
        ClusteringOptions clustering;
        clustering.num_clusters = num_clusters;
        clustering.assumed_components = subspace_dimension;
        clustering.max_components = kMaxSearchedComponents;
        clustering.memory_bytes = problem_.spare_bytes - kept_bytes_;
        const FactorPoints points(problem_.transfer, problem_.plane_weight);
        found = std::make_shared<const ClusteredPca>(
            clustered_pca(points, clustering, nullptr, problem_.bake.directory().string()));
        return found;
    }

    // The fewest components that leave this share of the error.
    uint32_t fewest_components(const ClusteredPca& pca, double most_error) const {
        const double num_poses = problem_.bake.num_poses();
        uint32_t k = 0;
        while (k <= pca.num_components && num_poses * pca.squared_error(k) > most_error) ++k;
        return k;
    }

    // Points are assigned to subspaces of about as many components as will be kept.
    std::shared_ptr<const ClusteredPca> choose_clusters(uint32_t num_clusters, double most_error) {
        uint32_t dimension = kFirstAssumedComponents;
        const uint32_t needed =
            fewest_components(*clusters(num_clusters, dimension), kUsualShare * most_error);
        if (needed > kMaxSearchedComponents) return nullptr;
        if (needed > dimension + dimension / 2) {
            dimension = kMaxAssumedComponents;
        } else if (needed <= dimension / 2) {
            dimension /= 2;
        }
        return clusters(num_clusters, dimension);
    }

    void add_clusters(uint32_t num_clusters, double most_error,
                      std::vector<TransferCoding>& codings) {
        const std::shared_ptr<const ClusteredPca> pca = choose_clusters(num_clusters, most_error);
        if (!pca) return;
        std::set<uint32_t> counts;
        for (const double share : {0.9, kUsualShare, 0.3}) {
            counts.insert(fewest_components(*pca, share * most_error));
        }
        for (const uint32_t count : counts) {
            if (count > kMaxSearchedComponents) continue;
            // With many more rows of bases than vertices, which cost less as they are, it is slow
            // to find out that nothing is gained; up to twice as many may still play faster.
            if (uint64_t{pca->num_clusters} * (count + 1) >
                2 * uint64_t{problem_.transfer.num_points}) {
                continue;
            }
            add_components(pca, count, most_error, codings);
        }
    }

    void add_components(const std::shared_ptr<const ClusteredPca>& pca, uint32_t num_components,
                        double most_error, std::vector<TransferCoding>& codings) {
        const auto cost = static_cast<uint32_t>(
            cpca_cost(problem_.layout, pca->num_clusters, num_components, 0, true).per_vertex());
        if (decode_cost_ && cost > *decode_cost_) return;
        auto settings = std::make_shared<CpcaSettings>(pca, num_components);
        settings->hold(settings->make_bases(problem_));
        const ClusteredFactors& bases = settings->held();
        TransferCoding coding;
        coding.quantiser = {1.0, problem_.transfer.num_components(), problem_.plane_weight};
        coding.quantiser.step = largest_step(bases, coding.quantiser, most_error);
        if (coding.quantiser.step == 0.0) return;
        const ClusteredMatrix quantised = quantise_clusters(bases, coding.quantiser);
        coding.candidate.codec = CpcaTransfer::kName;
        coding.candidate.components = quantised.matrix.num_components;
        coding.candidate.numbers = {{kClusters, pca->num_clusters},
                                    {kClusterComponents, num_components}};
        coding.candidate.multiply_adds = cost;
        coding.candidate.bytes = stored_bytes(quantised.matrix, PlanePredictor(), Effort::fast) +
                                 stored_bytes(quantised.clusters, problem_.predictor);
        coding.settings = std::move(settings);
        codings.push_back(std::move(coding));
        keep_bases_of_best(codings);
    }

    // Bases may be larger than the factors, so that only one candidate's are kept: most often the
    // chosen one's. Nothing but time depends on it.
    void keep_bases_of_best(std::vector<TransferCoding>& codings) {
        const TransferCoding* best = best_coding(codings, task_.target.preference, {});
        kept_bytes_ = 0;
        for (TransferCoding& coding : codings) {
            const uint64_t bytes = coding.settings->held_bytes();
            if (bytes == 0) continue;
            if (&coding == best && bytes <= problem_.unneeded_bytes) {
                kept_bytes_ = bytes;
            } else {
                coding.settings->release();
            }
        }
    }

    static constexpr double kUsualShare = 0.6;

    const TransferSearchTask task_;
    const EncodeProblem& problem_;
    std::optional<uint32_t> decode_cost_;
    // By number of clusters and of dimensions that their subspaces were assumed to have.
    std::map<std::pair<uint32_t, uint32_t>, std::shared_ptr<const ClusteredPca>> clusters_;
    uint64_t kept_bytes_ = 0;  // of bases
};

}  // namespace

TransferEncoderType cpca_encoder_type() {
    EncoderWords words;
    words.description = "clusters; much cheaper to play";
    words.cost = "3 (J + 1) in all for J components a cluster";
    words.missed = "cannot be met by clusters of as many components as are tried: use --codec auto";
    words.numbers = {kClusters, kClusterComponents};
    words.heading = "clusters x components";
    return {CpcaTransfer::kName, false,
            [](const TransferSearchTask& task) -> std::unique_ptr<TransferEncoder> {
                return std::make_unique<CpcaEncoder>(task);
            },
            cpca_memory, words};
}

}  // namespace paim
