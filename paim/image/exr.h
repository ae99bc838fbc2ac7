// Reads and writes OpenEXR images. Only image/exr*.cpp use OpenEXR.
#pragma once

#include <filesystem>

#include "paim/image/image.h"

namespace paim {

struct ExrLimits {
    int max_width = 16384;
    int max_height = 16384;
};

// Reads the RGB channels of a scan-line or tiled image, at full resolution. An image with luminance
// alone gives grey; luminance-chroma is converted. The result has the size of the display window.
// Pixels outside the data window are black. Memory is bounded by the limits, whatever the bytes.
// Errors (bad input) name the file and what is wrong: missing, not EXR, truncated, damaged, larger
// than the limits, a deep image, no colour channels.
Image read_exr(const std::filesystem::path& path, const ExrLimits& limits = {});

// Writes 32-bit float RGB, ZIP-compressed, all or nothing. Errors: output failed.
void write_exr(const std::filesystem::path& path, const Image& image);

}  // namespace paim
