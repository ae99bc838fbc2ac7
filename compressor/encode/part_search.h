// The cheapest integers for a part of an animation whose error must stay below something.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compressor/encode/quantise.h"
#include "paim/format/plane_predictor.h"

namespace paim {

struct PartChoice {
    Quantiser quantiser;
    LowRankMatrix matrix;
    uint64_t bytes = 0;  // stored_bytes() with fast effort
};

// Tries several numbers of components, each with the largest step that meets the error, and takes the
// one with the fewest bytes; of those within 1 % of it, the one with the fewest components.
// plane_weight     of squared errors
// most_error       weighted, Σ over rows and poses
// most_components  of the scores that may be kept
// Nothing if no step is small enough.
std::optional<PartChoice> cheapest_part(const Scores& scores,
                                        const std::vector<double>& plane_weight, double most_error,
                                        uint32_t most_components, const PlanePredictor& predictor);

}  // namespace paim
