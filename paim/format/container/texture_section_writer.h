// The bytes of the sections of a texture.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/format/container/texture_sections.h"
#include "paim/mesh/texture.h"

namespace paim {

// The bytes of one section of texture_sections().
// topology  whose triangles the corners are of
std::vector<uint8_t> texture_bytes(const Texture& texture, const Topology& topology,
                                   TexturePiece piece, uint32_t index);

}  // namespace paim
