// Reads PNG files with a decoder that is not the writer's.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace paim {

struct PngPicture {
    int width = 0, height = 0;
    std::vector<std::array<uint8_t, 3>> pixels;  // [height · width], row 0 on top
};

// Throws std::runtime_error, which names the file, if it is not a PNG of 8-bit RGB.
PngPicture read_png(const std::filesystem::path& path);

}  // namespace paim
