// Describes the images on the faces of a mesh.
#pragma once

#include <nlohmann/json.hpp>

#include "paim/mesh/texture.h"

namespace paim {

// Adds the members `num_textured_triangles`, `num_texture_coordinates` and `images` (of each its
// name, bytes and, unless it is damaged, pixels) to those of another texture; nothing if there are
// no images. Decodes the images.
void add_texture(const Texture& texture, nlohmann::ordered_json& json);

}  // namespace paim
