// Codec cpca in the search.
#include "compressor/encode/search/cpca/cpca_encoder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "compressor/encode/search/cpca/clustered_quantise.h"
#include "compressor/encode/search/cpca/clusterings.h"
#include "compressor/encode/search/cpca/cpca_memory.h"
#include "compressor/encode/search/cpca/fixed_clusters.h"
#include "compressor/encode/search/matrix_cost.h"
#include "compressor/encode/search/search_outwards.h"
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

// Numbers of clusters that are tried, ascending.
std::vector<uint32_t> cluster_counts(uint32_t num_vertices) {
    const auto most = static_cast<uint32_t>(most_clusters(num_vertices));
    std::vector<uint32_t> counts;
    for (const uint32_t count : kClusterCounts) {
        if (counts.empty() || counts.back() < most) counts.push_back(std::min(count, most));
    }
    return counts;
}

// Where among them the smallest files are most often: at about as many clusters as vertices in each.
size_t usual_place(const std::vector<uint32_t>& counts, uint32_t num_vertices) {
    const double usual = std::sqrt(static_cast<double>(num_vertices));
    const auto nearest = std::min_element(counts.begin(), counts.end(), [&](double a, double b) {
        return std::abs(std::log(a / usual)) < std::abs(std::log(b / usual));
    });
    return static_cast<size_t>(nearest - counts.begin());
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
    explicit CpcaEncoder(const TransferSearchTask& task)
        : problem_(task.problem),
          cluster_counts_(cluster_counts(problem_.transfer.num_points)),
          start_(usual_place(cluster_counts_, problem_.transfer.num_points)),
          keeps_all_(task.memos != nullptr),
          clusterings_(clusterings_of(task.memos)) {}

    void add_codings(const CodingRequest& request, std::vector<TransferCoding>& codings) override {
        kept_bytes_ = 0;
        request_ = request;
        std::vector<TransferCoding> found;
        const auto fewest_bytes = [&](size_t n) -> std::optional<uint64_t> {
            const size_t before = found.size();
            const bool fits = add_clusters(cluster_counts_[n], found);
            problem_.progress->advance(0.25);
            if (!fits) return kTooLarge;
            std::optional<uint64_t> fewest;
            for (size_t j = before; j < found.size(); ++j) {
                fewest =
                    std::min(fewest.value_or(found[j].candidate.bytes), found[j].candidate.bytes);
            }
            return fewest;
        };
        if (request.preference == Preference::size) {
            start_ = search_outwards(cluster_counts_.size(), start_, fewest_bytes);
        } else {
            for (size_t n = 0; n < cluster_counts_.size(); ++n) fewest_bytes(n);
        }
        std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) {
            return a.candidate.number(kClusters) < b.candidate.number(kClusters);
        });
        std::move(found.begin(), found.end(), std::back_inserter(codings));
    }

  private:
    // Clusters of one number, which stay for the next error.
    struct Found {
        std::shared_ptr<const ClusteredPca> pca;
        uint32_t subspace_dimension = 0;
    };

    // Unless that is what was found.
    void cluster(uint32_t num_clusters, uint32_t subspace_dimension, Found& found) {
        if (found.pca && found.subspace_dimension == subspace_dimension) return;
        if (found.pca) {
            found.pca.reset();  // first, so that there is memory
            if (!keeps_all_) clusterings_->forget(num_clusters, found.subspace_dimension);
        }
        found.pca = clusterings_->find(problem_, num_clusters, subspace_dimension,
                                       problem_.spare_bytes - kept_bytes_);
        found.subspace_dimension = subspace_dimension;
    }

    // At the error that is asked for; more than are known if these do not do.
    uint32_t needed_components(const ClusteredPca& pca) const {
        return fewest_components(pca, kUsualShare * request_.most_error);
    }

    // The fewest components that leave this share of the error.
    uint32_t fewest_components(const ClusteredPca& pca, double most_error) const {
        const double num_poses = problem_.bake.num_poses();
        uint32_t k = 0;
        while (k <= pca.num_components && num_poses * pca.squared_error(k) > most_error) ++k;
        return k;
    }

    // How many components so many clusters will need, by what the nearest number of clusters did.
    std::optional<double> expected_components(uint32_t num_clusters) const {
        // Of usual animations, 0.55 … 0.7.
        constexpr double kFall = 0.62;
        std::optional<double> expected;
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto& [count, found] : found_) {
            const double ratio = std::log(static_cast<double>(num_clusters) / count);
            if (!found.pca || std::abs(ratio) >= nearest) continue;
            nearest = std::abs(ratio);
            expected = needed_components(*found.pca) * std::exp(-kFall * ratio);
        }
        return expected;
    }

    // Points are assigned to subspaces of about as many dimensions as components will be kept.
    static uint32_t subspace_dimension(double needed) {
        constexpr uint32_t kUsual = kUsualAssumedComponents;
        if (needed > kUsual + kUsual / 2) return kMaxAssumedComponents;
        return needed > kUsual / 2 ? kUsual : kUsual / 2;
    }

    // Nothing if the error takes more components than are tried.
    std::shared_ptr<const ClusteredPca> choose_clusters(uint32_t num_clusters) {
        const std::optional<double> expected = expected_components(num_clusters);
        Found& found = found_[num_clusters];
        cluster(num_clusters, subspace_dimension(expected.value_or(kUsualAssumedComponents)),
                found);
        uint32_t needed = needed_components(*found.pca);
        const auto correct = [&] {
            cluster(num_clusters, subspace_dimension(needed), found);
            needed = needed_components(*found.pca);
        };
        if (!expected) correct();
        // An expectation may be far off. What is needed beyond all that are known is not known.
        while (needed > found.pca->num_components &&
               found.subspace_dimension < kMaxAssumedComponents) {
            correct();
        }
        return needed <= found.pca->num_components ? found.pca : nullptr;
    }

    // False if all codings have bases that are too large.
    bool add_clusters(uint32_t num_clusters, std::vector<TransferCoding>& codings) {
        const std::shared_ptr<const ClusteredPca> pca = choose_clusters(num_clusters);
        if (!pca) return true;
        bool fits = false;
        std::set<uint32_t> counts;
        for (const double share : kShares) {
            // Few components and fine steps play fast, but make no small files.
            if (share > kUsualShare && request_.preference == Preference::size &&
                !request_.decode_cost) {
                continue;
            }
            counts.insert(fewest_components(*pca, share * request_.most_error));
        }
        for (const uint32_t count : counts) {
            if (count > pca->num_components) continue;
            // With many more rows of bases than vertices, which cost less as they are, it is slow
            // to find out that nothing is gained; up to twice as many may still play faster.
            if (uint64_t{pca->num_clusters} * (count + 1) >
                2 * uint64_t{problem_.transfer.num_points}) {
                continue;
            }
            add_components(pca, count, codings);
            fits = true;
        }
        return fits;
    }

    void add_components(const std::shared_ptr<const ClusteredPca>& pca, uint32_t num_components,
                        std::vector<TransferCoding>& codings) {
        const auto cost = static_cast<uint32_t>(
            cpca_cost(problem_.layout, pca->num_clusters, num_components, 0, true).per_vertex());
        if (request_.decode_cost && cost > *request_.decode_cost) return;
        auto settings = std::make_shared<CpcaSettings>(pca, num_components);
        settings->hold(settings->make_bases(problem_));
        const ClusteredFactors& bases = settings->held();
        TransferCoding coding;
        coding.quantiser = {1.0, problem_.transfer.num_components(), problem_.plane_weight};
        coding.quantiser.step = largest_step(bases, coding.quantiser, request_.most_error);
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
        const TransferCoding* best = best_coding(codings, request_.preference);
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

    // Of the error that truncation may take.
    static constexpr double kUsualShare = 0.6;
    static constexpr std::array<double, 3> kShares{0.9, kUsualShare, 0.3};

    const EncodeProblem& problem_;
    const std::vector<uint32_t> cluster_counts_;  // ascending
    size_t start_;                                // where the search for the smallest file begins
    CodingRequest request_;
    const bool keeps_all_;  // clusterings, for other searches
    const std::shared_ptr<Clusterings> clusterings_;
    std::map<uint32_t, Found> found_;  // by number of clusters
    uint64_t kept_bytes_ = 0;          // of bases
};

}  // namespace

TransferEncoderType cpca_encoder_type() {
    EncoderWords words;
    words.description = "clusters; much cheaper to play";
    words.cost = "3 (J + 1) in all for J components a cluster";
    words.missed = "cannot be met by clusters of as many components as are tried: use --codec auto";
    words.numbers = {kClusters, kClusterComponents};
    words.heading = "clusters x components";
    return {CpcaTransfer::kName,
            false,
            [](const TransferSearchTask& task) -> std::unique_ptr<TransferEncoder> {
                return std::make_unique<CpcaEncoder>(task);
            },
            cpca_memory,
            words,
            &code_clusters};
}

}  // namespace paim
