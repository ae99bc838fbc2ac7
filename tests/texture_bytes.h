// PNG and JPEG files in memory, for tests of textures.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/image/srgb.h"

namespace paim {

// The colour types of PNG files (PNG Specification, third edition, section 11.2.1).
enum class PngColor : uint8_t { grey = 0, rgb = 2, palette = 3, grey_alpha = 4, rgba = 6 };

// A PNG file of any colour type.
// samples  [height] rows of whole bytes each, as PNG stores them: 16-bit values high byte first
// palette  of PngColor::palette
std::vector<uint8_t> png_file(uint32_t width, uint32_t height, int bit_depth, PngColor color,
                              std::span<const uint8_t> samples, std::span<const Rgb8> palette = {});

// pixels  [height][width] sRGB, the top row first
std::vector<uint8_t> png_bytes(uint32_t width, uint32_t height, std::span<const Rgb8> pixels);
// quality  1 … 100
std::vector<uint8_t> jpeg_bytes(uint32_t width, uint32_t height, std::span<const Rgb8> pixels,
                                int quality);

}  // namespace paim
