// One way to code the transfer that was tried, whatever its codec.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "compressor/encode/options.h"
#include "compressor/encode/quantise/quantise.h"
#include "compressor/encode/search/problem.h"

namespace paim {

// What a codec has to remember to code the transfer with another step.
class CodecSettings {
  public:
    virtual ~CodecSettings() = default;

    // Error (unsupported) if the step is so small that values do not fit in 16 bits.
    virtual CodedTransfer code(const EncodeProblem& problem, const Quantiser& quantiser,
                               Precision precision) const = 0;

    // Weighted squared error of integers with this step against the problem's factors, over all
    // rows and poses, without the rounding of weights: an estimate of the error that code() leaves.
    virtual double squared_error(const EncodeProblem& problem,
                                 const Quantiser& quantiser) const = 0;

    // Memory that saves time when it codes: how much is held, and letting go of it.
    virtual uint64_t held_bytes() const { return 0; }
    virtual void release() {}
};

// Settings, with the step that meets the error.
struct TransferCoding {
    Candidate candidate;
    Quantiser quantiser;
    Precision precision = Precision::i16;  // or floats, which have no step
    std::shared_ptr<CodecSettings> settings;
};

// What a coding may take.
struct CodingLimits {
    std::optional<uint64_t> bytes = {};
    // Not asked of anything where no coding within `bytes` is as cheap.
    std::optional<uint32_t> multiply_adds = {};
};

// The best within the limits, by preference: fewest bytes, or within 1 % of that fewer
// multiply-adds; or fewest multiply-adds and of these fewest bytes. Nothing if there are none.
const TransferCoding* best_coding(const std::vector<TransferCoding>& codings, Preference preference,
                                  CodingLimits limits = {});

}  // namespace paim
