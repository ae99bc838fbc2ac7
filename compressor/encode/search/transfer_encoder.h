// The search for codings of the transfer, codec by codec.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compressor/encode/memory/target_memory.h"
#include "compressor/encode/search/transfer_coding.h"

namespace paim {

// What a codec keeps from one search to the next on the same components of the transfer. It holds
// functions of the problem alone, never of what was searched before, so that files do not depend on
// it.
struct CodecMemo {
    virtual ~CodecMemo() = default;
};
using CodecMemos = std::map<std::string, std::shared_ptr<CodecMemo>>;  // by codec

// What every codec's search is about. References outlive the search.
struct TransferSearchTask {
    const EncodeProblem& problem;
    const EncodeOptions& options;
    const EncodeTarget& target;
    // Of a series of searches, which may take more memory than CodecMemory says; else null.
    CodecMemos* memos = nullptr;
};

// What codings are asked for.
struct CodingRequest {
    // Weighted squares over rows and poses, against the factors.
    double most_error = 0.0;
    // Multiply-adds a vertex and frame that are allowed.
    std::optional<uint32_t> decode_cost = {};
    // What the best of them will be chosen by. Codings that are clearly worse need not be tried.
    Preference preference = Preference::size;
};

class TransferEncoder {
  public:
    virtual ~TransferEncoder() = default;

    // Adds all codings that were tried, meet the error and are cheap enough to decode.
    virtual void add_codings(const CodingRequest& request,
                             std::vector<TransferCoding>& codings) = 0;
};

// What people are told about a codec.
struct EncoderWords {
    const char* description = "";  // what vertices are made of: "components over the poses"
    const char* cost = "";  // multiply-adds per vertex and frame: "K + 4 for each coefficient"
    // After "a transfer error of 1 % …": why this codec alone may not meet it, and what to do.
    const char* missed = "";
    // Names of the Candidate::numbers that this codec chooses, and the heading of their column.
    std::vector<const char*> numbers = {};
    const char* heading = "";
};

// How a codec is searched.
struct TransferEncoderType {
    std::string_view codec;
    bool codes_floats;  // else integers alone
    std::unique_ptr<TransferEncoder> (*make)(const TransferSearchTask& task);
    CodecMemory (*memory)(const TargetSize& size);
    EncoderWords words;
    // Codes the transfer in so many groups of vertices (codec/point_groups.h), or as many as there are
    // vertices for. There is no target: a vertex has as many components as is usual, and steps add little
    // to the error. The first name of words.numbers is that of the groups. Null: the number of groups cannot
    // be chosen.
    // Errors: unsupported if there is not enough memory.
    CodedTransfer (*code_groups)(const TransferSearchTask& task, uint32_t num_groups) = nullptr;
};

// In the order of the search; those that were added come last. transfer_encoders.cpp is the one
// place that names them.
const std::vector<TransferEncoderType>& transfer_encoders();

// Adds a codec that searches try from then on. add_transfer_codec() has added the codec itself, no
// other encoder has its name, and its words are complete (checked). Must be called before any other
// thread uses Paim. Invalidates what transfer_encoders() and encoders_to_try() returned.
// type  whose codec name and words live as long as the program
void add_transfer_encoder(TransferEncoderType type);

// Those that a target lets a search try.
// codec      of EncodeTarget
// Error (usage): no encoder has that name (the message lists the names), or it does not code floats
// and the precision is one of floats.
std::vector<const TransferEncoderType*> encoders_to_try(std::string_view codec,
                                                        Precision precision);

// What check_target_memory() and its like ask of these.
std::vector<SearchedCodec> searched_codecs(const std::vector<const TransferEncoderType*>& types);

}  // namespace paim
