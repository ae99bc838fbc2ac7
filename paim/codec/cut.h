// Leaves out bands and components of coded data, without computing anything again.
#pragma once

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"

namespace paim {

// Keeps the first bands of the transfer, at least one.
void keep_bands(CodedMesh& mesh, uint32_t bands);

// Keeps bands of all parts, and components over the poses, within the limits. Components of each vertex
// stay.
void keep_within(const DecodeLimits& limits, Asset& asset);

}  // namespace paim
