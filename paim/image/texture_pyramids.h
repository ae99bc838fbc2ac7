// The images of a texture, decoded, with all their levels.
#pragma once

#include <span>
#include <vector>

#include "paim/image/mip_pyramid.h"
#include "paim/mesh/texture.h"

namespace paim {

// Errors: those of decode_texture(); all images together have at most max_pixels.
// returns  one for each image
std::vector<MipPyramid> make_pyramids(std::span<const TextureImage> images,
                                      int64_t max_pixels = kMaxTexturePixels);

}  // namespace paim
