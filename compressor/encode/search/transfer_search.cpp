// Ways to code the transfer that meet an error.
#include "compressor/encode/search/transfer_search.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace paim {

TransferSearch::TransferSearch(const EncodeProblem& problem, const EncodeOptions& options,
                               const EncodeTarget& target)
    : bands_(problem.layout.in_bands), decode_cost_(target.decode_cost) {
    for (const TransferEncoderType* type : encoders_to_try(target.codec, options.precision)) {
        encoders_.push_back(type->make({problem, options, target}));
    }
}

std::vector<TransferCoding> TransferSearch::codings(double most_error,
                                                    std::optional<uint32_t> decode_cost) {
    std::vector<TransferCoding> codings;
    for (const auto& encoder : encoders_) encoder->add_codings(most_error, decode_cost, codings);
    for (TransferCoding& coding : codings) coding.candidate.bands = bands_;
    return codings;
}

std::optional<uint32_t> TransferSearch::least_multiply_adds(double most_error) {
    const std::vector<TransferCoding> all = codings(most_error, std::nullopt);
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
