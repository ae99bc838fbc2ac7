// The gloss of an asset as an asset whose transfer it is, so that code of the transfer can encode,
// measure and analyse it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/asset.h"

namespace paim {

// Rows are its vertices, the faces among them its triangles, the tints its albedo, and its transfer is
// the glossy one. It has the still part if that is glossy, too. Its provenance is the member `gloss` of
// that of the whole.
// whole  whose moving part has gloss (checked)
Asset gloss_asset(const Asset& whole);

// Gives an asset the gloss of another one, which is such an asset.
// vertices  the vertices of the whole's moving part that the vertices of the gloss are
// still     the same of the still parts; empty if the still part of the gloss is missing
void join_gloss(Asset gloss, std::span<const uint32_t> vertices, std::span<const uint32_t> still,
                Asset& whole);

}  // namespace paim
