// From planes of coefficients to texels of four.
#pragma once

#include <cstdint>
#include <span>

#include "paim/codec/stored_values.h"

namespace paim::player {

// Planes of `num_vertices` values each, channel after channel, as they lie in a mean or component.
struct PlaneView {
    const StoredValues* values;
    std::span<const float> steps;  // of the planes in memory; none: 1 each
    uint32_t num_vertices;
    uint32_t planes_per_channel;  // in memory
    uint32_t planes_used;         // the first of each channel that are wanted
    uint32_t groups_per_channel;  // texels of one vertex and channel: planes_used / 4, rounded up
};

// Gathers texels first … first + out.size() / 4 − 1 of the view, where texel = group · V + v and
// the groups of a channel hold its wanted planes; what is left of a channel's last group becomes
// zero.
void gather_groups(const PlaneView& view, int64_t first, std::span<float> out);

}  // namespace paim::player
