// From planes of values to texels of four.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "paim/codec/stored_values.h"

namespace paim::player {

// Where a lane of a texel comes from: the values of vertices 0 … V−1; none: zeros.
struct Lane {
    const StoredValues* values = nullptr;
    size_t first = 0;  // that of vertex 0
};

// Writes the texels first … first + out.size() / 4 − 1, in steps; texel group · V + v is vertex v
// of a group.
// num_vertices  V, at least 1
// lane_of       of lane 0 … 3 of a group
// Value         float, int16_t or int8_t; holds every value exactly
template <typename Value>
void gather_groups(uint32_t num_vertices, const std::function<Lane(uint32_t, uint32_t)>& lane_of,
                   int64_t first, std::span<Value> out);

// Groups of the planes of a mean or component, channel after channel; what is left of a channel's
// last group is zero.
struct PlaneGroups {
    uint32_t num_vertices;
    uint32_t num_channels;
    uint32_t planes_per_channel;  // in memory
    uint32_t planes_used;         // the first of each channel that are wanted
    uint32_t groups_per_channel;  // planes_used / 4, rounded up

    uint32_t num_groups() const { return num_channels * groups_per_channel; }
    Lane lane(const StoredValues& values, uint32_t group, uint32_t lane) const;
};

}  // namespace paim::player
