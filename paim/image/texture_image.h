// Decodes the images of textures: PNG and JPEG files in memory.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "paim/image/srgb.h"

namespace paim {

// The most pixels of an image that is decoded, unless a caller says otherwise: 8192 × 8192.
constexpr int64_t kMaxTexturePixels = int64_t{1} << 26;

struct DecodedTexture {
    int width = 0;
    int height = 0;
    std::vector<Rgb8> pixels;  // [height · width] sRGB; row 0 is the top row
};

// Decodes a PNG or JPEG file. Grey images have three equal channels; of 16-bit channels the upper
// eight bits are kept. Transparency is ignored: the colour of a pixel is that of the file, whatever
// its alpha. Colour profiles and gamma values of files are ignored, too: values are sRGB.
// bytes       of the whole file
// name        of the image, for messages
// max_pixels  at least 1. It bounds the memory in use, whatever the bytes say: no block is larger than
//             some 20 bytes for each pixel of the image, twice the bytes of the file and 1 MiB.
// Errors (bad input) name the image: neither PNG nor JPEG, truncated, damaged, more pixels than
// max_pixels.
DecodedTexture decode_texture(std::span<const uint8_t> bytes, std::string_view name,
                              int64_t max_pixels = kMaxTexturePixels);

}  // namespace paim
