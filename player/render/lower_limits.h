// Limits of decoding within others.
#pragma once

#include <algorithm>

#include "paim/codec/decode_limits.h"

namespace paim::player {

// The lower number of each kind.
inline DecodeLimits lower_of(const DecodeLimits& a, const DecodeLimits& b) {
    return {std::min(a.geometry_components, b.geometry_components),
            std::min(a.transfer_components, b.transfer_components),
            std::min(a.bands, b.bands),
            std::min(a.vertex_components, b.vertex_components),
            std::min(a.gloss_components, b.gloss_components),
            std::min(a.gloss_vertex_components, b.gloss_vertex_components)};
}

}  // namespace paim::player
