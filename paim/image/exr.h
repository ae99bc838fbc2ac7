// Reads and writes OpenEXR images. Only image/exr*.cpp use OpenEXR.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "paim/image/chromaticities.h"
#include "paim/image/image.h"

namespace paim {

struct ExrLimits {
    int max_width = 16384;
    int max_height = 16384;
};

// What a file says of the part that is read, its first. Attributes of another type than OpenEXR's
// standard one count as missing.
struct ExrHeader {
    int width = 0;  // of the display window
    int height = 0;
    int num_parts = 1;
    std::string part_name;  // often empty
    // The attribute `envmap`: 0 is a lat-long map, 1 a cube map (ImfEnvmap.h).
    std::optional<int> envmap;
    std::optional<Chromaticities> chromaticities;  // as stated, which may be any numbers
    std::optional<double> white_luminance;         // of RGB (1, 1, 1), candela per square metre
};

// Errors: those of read_exr() that headers have.
ExrHeader read_exr_header(const std::filesystem::path& path, const ExrLimits& limits = {});

// Pixels of row y of the display window, from column x on.
using ExrRun = std::function<void(int x, int y, std::span<const Vec3f> pixels)>;

// Reads like read_exr(), and hands on each pixel of the data window once, in runs. Those of a row
// come from left to right. Rows come in any order. It holds 8 MiB of pixels, or one tile, in
// addition to what OpenEXR itself needs (check_exr_header()).
void read_exr_rows(const std::filesystem::path& path, const ExrRun& on_run,
                   const ExrLimits& limits = {});

// Reads the RGB channels of a scan-line or tiled image, at full resolution. An image with luminance
// alone gives grey; luminance-chroma is converted. The result has the size of the display window.
// Pixels outside the data window are black. Memory is bounded by the limits, whatever the bytes.
// Errors (bad input) name the file and what is wrong: missing, not EXR, truncated, damaged, larger
// than the limits, a deep image, no colour channels.
Image read_exr(const std::filesystem::path& path, const ExrLimits& limits = {});

// Writes 32-bit float RGB, ZIP-compressed, all or nothing. Errors: output failed.
void write_exr(const std::filesystem::path& path, const Image& image);

}  // namespace paim
