// What a file shall meet, and what was chosen to meet it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "paim/metrics/band_power.h"

namespace paim {

enum class CodecChoice : uint32_t { automatic, svd, cpca };

// Which of the files that meet the target is best.
enum class Preference : uint32_t {
    size,   // the smallest
    speed,  // the one with the fewest multiply-adds a vertex and frame, then the smallest
};

// At least one of transfer_error and size_bytes is set.
struct EncodeTarget {
    std::optional<double> transfer_error;  // expected against the truth, relative, 0 … 1
    std::optional<double> geometry_error;  // RMS distance by the diagonal; else from transfer_error
    std::optional<uint64_t> size_bytes;    // of the file, at most
    std::optional<uint32_t> decode_cost;   // multiply-adds a vertex and frame for lit transfer
    CodecChoice codec = CodecChoice::automatic;
    Preference preference = Preference::size;
    BandPower spectrum = BandPower::flat(1);
};

// Where transfer_error E is asked for and geometry_error is not: E / 50 of the diagonal. A figure a
// thousand pixels high then errs by 0.2 pixels at 1 % and by one at 5 %.
constexpr double kGeometryPerTransferError = 1.0 / 50.0;

// One way to code the transfer that was tried.
struct Candidate {
    std::string codec;  // "svd" or "cpca"
    uint32_t bands = 0;
    uint32_t components = 0;          // over time
    uint32_t clusters = 0;            // of cpca
    uint32_t cluster_components = 0;  // of cpca
    uint64_t bytes = 0;               // of the transfer, before the last squeeze
    uint32_t multiply_adds = 0;       // a vertex and frame
    bool chosen = false;
};

}  // namespace paim
