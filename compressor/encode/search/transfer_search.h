// Ways to code the transfer that meet an error, of all codecs that a target allows.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "compressor/encode/search/transfer_encoder.h"

namespace paim {

// Multiply-adds a vertex and frame, under coloured light, of the plainest storage that meets the
// error: components as floats, as few as do.
// most_error  as for codings()
uint32_t plain_multiply_adds(const EncodeProblem& problem, double most_error);

class TransferSearch {
  public:
    // memos  of a series of searches on the same components
    TransferSearch(const EncodeProblem& problem, const EncodeOptions& options,
                   const EncodeTarget& target, CodecMemos* memos = nullptr);

    // All that were tried and meet the error and the decode cost; none if nothing does. Settings
    // may hold memory until the next call, and codings of an earlier call have to be gone by then.
    // most_error  weighted squares over rows and poses, against the factors
    std::vector<TransferCoding> codings(double most_error) {
        return codings({most_error, decode_cost_, preference_});
    }

    // Of all that meet the error at any decode cost; nothing if nothing does. As long as codings().
    std::optional<uint32_t> least_multiply_adds(double most_error);

  private:
    std::vector<TransferCoding> codings(const CodingRequest& request);

    const uint32_t bands_;
    const Preference preference_;
    const std::optional<uint32_t> decode_cost_;
    std::vector<std::unique_ptr<TransferEncoder>> encoders_;
};

}  // namespace paim
