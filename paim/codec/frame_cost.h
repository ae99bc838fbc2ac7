// Multiply-adds of one frame.
#pragma once

#include <cstdint>

#include "paim/transfer/layout.h"

namespace paim {

// Multiply-adds of decoding and lighting one frame. A mean counts as a component of weight 1.
struct FrameCost {
    uint64_t decode_per_vertex = 0;
    uint64_t light_per_vertex = 0;  // to light a decoded vertex
    uint64_t cpu_per_frame = 0;     // once for all vertices

    uint64_t per_vertex() const { return decode_per_vertex + light_per_vertex; }
};

// Channels of radiance that are computed for a vertex: 1 for grey transfer under grey light,
// otherwise 3.
inline uint32_t num_radiance_channels(const TransferLayout& layout, bool coloured_light) {
    return coloured_light || layout.channels > 1 ? 3 : 1;
}

// Cost of positions: mean and components of three coordinates.
inline FrameCost positions_cost(uint32_t num_components) {
    return {3 * (uint64_t{num_components} + 1), 0, 0};
}

}  // namespace paim
