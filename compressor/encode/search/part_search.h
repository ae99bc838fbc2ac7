// The cheapest integers for a part of an animation whose error must stay below something.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "compressor/encode/options.h"
#include "compressor/encode/quantise/quantise.h"
#include "paim/format/pack/plane_predictor.h"

namespace paim {

struct PartChoice {
    Quantiser quantiser;
    uint32_t num_components = 0;  // that are more than zero
    uint64_t bytes = 0;           // stored_bytes() with fast effort
};

// Several numbers of components, ascending, each with the largest step that meets the error; none
// if no step is small enough. For the preference `size`, those with clearly more bytes than others need
// not be among them.
// plane_weight     of squared errors
// most_error       weighted, Σ over rows and poses
// most_components  of the factors that may be kept
// least_components that are kept of those
// num_counted      of the points, whose errors count: the first ones
std::vector<PartChoice> part_choices(const ScaledFactors& factors,
                                     const std::vector<double>& plane_weight, double most_error,
                                     uint32_t most_components, const PlanePredictor& predictor,
                                     uint32_t num_counted, uint32_t least_components = 0,
                                     Preference preference = Preference::size);

// Of these the one with the fewest bytes, or fewer components within 1 % of it.
std::optional<PartChoice> cheapest_part(std::vector<PartChoice> choices);

// Weighted squares of the components from the k-th on, Σ over rows and poses: what is lost without
// them. [K + 1]
std::vector<double> tail_errors(const ScaledFactors& factors,
                                const std::vector<double>& plane_weight);

// The fewest components without which no more than the error is lost; all if there are none.
// tails  as tail_errors() has them
uint32_t fewest_components(const std::vector<double>& tails, double most_error);

}  // namespace paim
