// Ways to code the transfer that meet an error.
#include "compressor/encode/search/transfer_search.h"

#include <algorithm>
#include <utility>

#include "compressor/encode/search/part_search.h"
#include "paim/codec/codecs.h"
#include "paim/codec/frame_cost.h"

namespace paim {

TransferSearch::TransferSearch(const EncodeProblem& problem, const EncodeOptions& options,
                               const EncodeTarget& target, CodecMemos* memos)
    : bands_(problem.layout.in_bands),
      preference_(target.preference),
      decode_cost_(target.decode_cost) {
    for (const TransferEncoderType* type : encoders_to_try(target.codec, options.precision)) {
        encoders_.push_back(type->make({problem, options, target, memos}));
    }
}

std::vector<TransferCoding> TransferSearch::codings(const CodingRequest& request) {
    std::vector<TransferCoding> codings;
    for (const auto& encoder : encoders_) encoder->add_codings(request, codings);
    for (TransferCoding& coding : codings) coding.candidate.bands = bands_;
    return codings;
}

std::optional<uint32_t> TransferSearch::least_multiply_adds(double most_error) {
    const std::vector<TransferCoding> all = codings({most_error, std::nullopt, Preference::speed});
    const auto cheapest =
        std::min_element(all.begin(), all.end(), [](const auto& a, const auto& b) {
            return a.candidate.multiply_adds < b.candidate.multiply_adds;
        });
    if (cheapest == all.end()) return std::nullopt;
    return cheapest->candidate.multiply_adds;
}

uint32_t plain_multiply_adds(const EncodeProblem& problem, double most_error) {
    LowRank matrix;
    matrix.num_points = problem.transfer.num_points;
    matrix.num_planes = problem.transfer.num_planes;
    matrix.num_components =
        fewest_components(tail_errors(problem.transfer, problem.plane_weight), most_error);
    const CodedTransfer plain = plain_transfer(std::move(matrix));
    return static_cast<uint32_t>(plain->cost(problem.layout, {}, true).per_vertex());
}

const TransferCoding* best_coding(const std::vector<TransferCoding>& codings, Preference preference,
                                  CodingLimits limits) {
    std::vector<const TransferCoding*> allowed;
    for (const TransferCoding& coding : codings) {
        if (!limits.bytes || coding.candidate.bytes <= *limits.bytes) allowed.push_back(&coding);
    }
    const auto is_dear = [&](const TransferCoding* coding) {
        return limits.multiply_adds && coding->candidate.multiply_adds > *limits.multiply_adds;
    };
    if (!std::all_of(allowed.begin(), allowed.end(), is_dear)) std::erase_if(allowed, is_dear);
    if (allowed.empty()) return nullptr;
    if (preference == Preference::size) {
        uint64_t fewest = allowed[0]->candidate.bytes;
        for (const TransferCoding* coding : allowed) {
            fewest = std::min(fewest, coding->candidate.bytes);
        }
        std::erase_if(allowed, [&](const TransferCoding* coding) {
            return coding->candidate.bytes > fewest + fewest / 100;
        });
    }
    return *std::min_element(allowed.begin(), allowed.end(), [](const auto* a, const auto* b) {
        return std::pair(a->candidate.multiply_adds, a->candidate.bytes) <
               std::pair(b->candidate.multiply_adds, b->candidate.bytes);
    });
}

}  // namespace paim
