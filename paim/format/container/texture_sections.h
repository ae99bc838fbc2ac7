// The texture of a mesh as sections of .paim and .bake files.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/format/container/container_reader.h"
#include "paim/format/container/sections.h"
#include "paim/mesh/texture.h"

namespace paim {

enum class TexturePiece { names, image, coordinates, corners, of_face, factors };

// A piece of a texture, and the section that holds it.
struct TextureSection {
    TexturePiece piece;
    SectionSpec spec;
};

// All sections of a texture, in the order of the file; none if it is empty.
std::vector<TextureSection> texture_sections(const Texture& texture,
                                             const section::TextureTags& tags);

// The texture of these triangles; empty if the file has none of the sections.
// Errors (bad input) name the file and the section: a section is missing or has another shape or
// type; numbers of images or coordinates that do not exist; coordinates that are not finite; factors
// outside 0 … 1. Images are not decoded.
Texture read_texture(const ContainerReader& reader, const Topology& topology,
                     const section::TextureTags& tags);

// The section of corners holds differences, so that neighbours are small numbers: each corner of a
// face with an image minus the one before it in the section (0 before the first), as
// 2d for d ≥ 0 and −2d − 1 below, modulo 2³². Each face begins with the corner of its lowest vertex
// (mesh/lowest_corner.h), because packed triangles may come back rotated. Faces without an image
// are three zeros, and are passed over.
inline uint32_t corner_difference(uint32_t corner, uint32_t before) {
    const uint32_t difference = corner - before;
    return difference < 0x80000000u ? 2 * difference : 2 * ~difference + 1;
}
inline uint32_t corner_after(uint32_t before, uint32_t stored) {
    return before + (stored % 2 == 0 ? stored / 2 : ~(stored / 2));
}

}  // namespace paim
