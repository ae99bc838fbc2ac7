// Removes bands and components of coded data. The remaining values stay as they are.
#pragma once

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"

namespace paim {

// Keeps the first bands of the transfer, and of the gloss, at least one.
void keep_bands(CodedMesh& mesh, uint32_t bands);

// Keeps the first bands of outgoing radiance of transfer that is glossy itself, at least one.
void keep_out_bands(CodedMesh& mesh, uint32_t bands);

// Keeps the bands, and the components over the poses, of all parts within the limits. The limits of
// components of vertices are left to playing.
void keep_within(const DecodeLimits& limits, Asset& asset);

}  // namespace paim
