// Test assets with images on their faces.
#pragma once

#include <functional>

#include "paim/codec/asset.h"
#include "paim/image/srgb.h"
#include "tests/player/test_asset.h"

namespace paim::player {

// A PNG file of width × height pixels.
TextureImage make_image(uint32_t width, uint32_t height,
                        const std::function<Rgb8(uint32_t x, uint32_t y)>& color);

// Images around the sphere of make_test_asset(): u grows along each ring, so that the first vertices
// of rings have two places in an image, u = 0 and u = repeats. v grows to the first pole.
// image_of_face  as in Texture
Texture wrap(const Topology& topology, uint32_t num_rings, float repeats,
             std::vector<TextureImage> images,
             const std::function<uint16_t(size_t face)>& image_of_face);

}  // namespace paim::player
