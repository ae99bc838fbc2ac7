// The search for codings of the transfer, codec by codec.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "compressor/encode/search/transfer_coding.h"

namespace paim {

// What every codec's search is about. References outlive the search.
struct TransferSearchTask {
    const EncodeProblem& problem;
    const EncodeOptions& options;
    const EncodeTarget& target;
};

class TransferEncoder {
  public:
    virtual ~TransferEncoder() = default;

    // Adds all codings that were tried, meet the error and are cheap enough to decode.
    // most_error   weighted squares over rows and poses, against the factors
    // decode_cost  multiply-adds a vertex and frame that are allowed
    virtual void add_codings(double most_error, std::optional<uint32_t> decode_cost,
                             std::vector<TransferCoding>& codings) = 0;
};

// How the search for a codec is started.
struct TransferEncoderType {
    std::string_view codec;
    bool codes_floats;  // else integers alone
    std::unique_ptr<TransferEncoder> (*make)(const TransferSearchTask& task);
};

// In the order of the search. transfer_encoders.cpp is the one place that names them.
const std::vector<TransferEncoderType>& transfer_encoders();

}  // namespace paim
