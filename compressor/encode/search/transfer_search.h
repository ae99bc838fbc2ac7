// Ways to code the transfer that meet an error, and which of them is best.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compressor/encode/options.h"
#include "compressor/encode/quantise/clustered_quantise.h"
#include "compressor/encode/search/problem.h"

namespace paim {

// One way, with the step that meets the error.
struct TransferCoding {
    Candidate candidate;
    Quantiser quantiser;
    std::shared_ptr<const ClusteredPca> clusters;  // of cpca
    // Of these clusters, or none: then apply() makes them.
    std::shared_ptr<const ClusteredFactors> bases;
    Precision precision = Precision::i16;  // or floats, which have no step

    // Of cpca.
    std::shared_ptr<const ClusteredFactors> make_bases(const EncodeProblem& problem) const;

    // Sets the transfer and the clusters of a model.
    void apply(const EncodeProblem& problem, Model& model) const;
};

class TransferSearch {
  public:
    TransferSearch(const EncodeProblem& problem, const EncodeOptions& options,
                   const EncodeTarget& target);

    // All that were tried and meet the error and the decode cost; none if nothing does. Bases are those
    // of the best by the target's preference, if there is memory for them, until the next call: whoever
    // has codings of an earlier one drops their bases first.
    // most_error  weighted squares over rows and poses, against the factors
    std::vector<TransferCoding> codings(double most_error);

    // Of all that meet the error at any decode cost; nothing if nothing does. As long as codings().
    std::optional<uint32_t> least_multiply_adds(double most_error);

  private:
    void add_floats(double most_error, std::vector<TransferCoding>& codings) const;
    void add_svd(double most_error, std::vector<TransferCoding>& codings) const;
    void add_all_clusters(double most_error, std::vector<TransferCoding>& codings);
    void add_clusters(uint32_t num_clusters, double most_error,
                      std::vector<TransferCoding>& codings);
    std::shared_ptr<const ClusteredPca> clusters(uint32_t num_clusters,
                                                 uint32_t assumed_components);
    void keep_bases_of_best(std::vector<TransferCoding>& codings);
    bool cheap_enough(uint64_t multiply_adds) const {
        return !decode_cost_ || multiply_adds <= *decode_cost_;
    }

    const EncodeProblem& problem_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    std::optional<uint32_t> decode_cost_;  // the target's, but for least_multiply_adds()
    // By number of clusters and of components assumed.
    std::map<std::pair<uint32_t, uint32_t>, std::shared_ptr<const ClusteredPca>> clusters_;
    uint64_t kept_bytes_ = 0;  // of bases
};

// The best by preference: fewest bytes, or within 1 % of that fewer multiply-adds; or fewest
// multiply-adds and of these fewest bytes. Nothing if there are none.
// most_bytes  only those that are not larger are looked at
const TransferCoding* best_coding(const std::vector<TransferCoding>& codings, Preference preference,
                                  std::optional<uint64_t> most_bytes);

}  // namespace paim
