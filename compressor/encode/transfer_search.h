// Ways to code the transfer that meet an error, and which of them is best.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "compressor/encode/cluster_transfer.h"
#include "compressor/encode/encode_target.h"
#include "compressor/encode/material.h"

namespace paim {

// One way, with the step that meets the error.
struct TransferCoding {
    Candidate candidate;
    Quantiser quantiser;
    std::shared_ptr<const ClusteredPca> clusters;  // of cpca
    Precision precision = Precision::i16;          // or floats, which have no step

    // Sets the transfer and the clusters of a model.
    void apply(const Material& material, Model& model) const;
};

class TransferSearch {
  public:
    TransferSearch(const Material& material, const EncodeOptions& options,
                   const EncodeTarget& target);

    // All that were tried and meet the error and the decode cost; none if nothing does.
    // most_error  weighted squares over rows and poses, against the scores
    std::vector<TransferCoding> codings(double most_error);

  private:
    struct Clusters {
        std::shared_ptr<const ClusteredPca> pca;
    };

    void add_floats(double most_error, std::vector<TransferCoding>& codings) const;
    void add_svd(double most_error, std::vector<TransferCoding>& codings) const;
    void add_all_clusters(double most_error, std::vector<TransferCoding>& codings);
    void add_clusters(uint32_t num_clusters, double most_error,
                      std::vector<TransferCoding>& codings);
    const Clusters& clusters(uint32_t num_clusters, uint32_t assumed_components);
    bool cheap_enough(uint64_t multiply_adds) const {
        return !target_.decode_cost || multiply_adds <= *target_.decode_cost;
    }

    const Material& material_;
    const EncodeOptions& options_;
    const EncodeTarget& target_;
    std::map<std::pair<uint32_t, uint32_t>, Clusters> clusters_;  // clusters, components assumed
};

// The best by preference: fewest bytes, or within 1 % of that fewer multiply-adds; or fewest
// multiply-adds and of these fewest bytes. Nothing if there are none.
// most_bytes  only those that are not larger are looked at
const TransferCoding* best_coding(const std::vector<TransferCoding>& codings, Preference preference,
                                  std::optional<uint64_t> most_bytes);

}  // namespace paim
