// PNG chunks by hand, JPEG by stb_image_write.
// Based on: W3C, PNG Specification, third edition, 2025
#include "tests/texture_bytes.h"

#include <cstdlib>
#include <string_view>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace paim {

namespace {

void append_u32(std::vector<uint8_t>& bytes, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) {
        bytes.push_back(static_cast<uint8_t>(value >> shift));
    }
}

// Annex D of the specification.
uint32_t crc_of(std::span<const uint8_t> bytes) {
    uint32_t crc = 0xffffffffu;
    for (const uint8_t byte : bytes) {
        crc ^= byte;
        for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

void append_chunk(std::vector<uint8_t>& file, std::string_view type,
                  std::span<const uint8_t> data) {
    append_u32(file, static_cast<uint32_t>(data.size()));
    const size_t begin = file.size();
    file.insert(file.end(), type.begin(), type.end());
    file.insert(file.end(), data.begin(), data.end());
    append_u32(file, crc_of(std::span(file).subspan(begin)));
}

std::vector<uint8_t> deflated(std::vector<uint8_t> bytes) {
    int size = 0;
    unsigned char* packed =
        stbi_zlib_compress(bytes.data(), static_cast<int>(bytes.size()), &size, 8);
    std::vector<uint8_t> result(packed, packed + size);
    std::free(packed);
    return result;
}

}  // namespace

std::vector<uint8_t> png_file(uint32_t width, uint32_t height, int bit_depth, PngColor color,
                              std::span<const uint8_t> samples, std::span<const Rgb8> palette) {
    std::vector<uint8_t> file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    std::vector<uint8_t> header;
    append_u32(header, width);
    append_u32(header, height);
    header.insert(header.end(),
                  {static_cast<uint8_t>(bit_depth), static_cast<uint8_t>(color), 0, 0, 0});
    append_chunk(file, "IHDR", header);
    if (!palette.empty()) append_chunk(file, "PLTE", {palette[0].data(), 3 * palette.size()});
    std::vector<uint8_t> rows;
    const size_t row_bytes = height == 0 ? 0 : samples.size() / height;
    for (size_t begin = 0; begin < samples.size(); begin += row_bytes) {
        rows.push_back(0);  // no filter
        const auto row = samples.subspan(begin, row_bytes);
        rows.insert(rows.end(), row.begin(), row.end());
    }
    append_chunk(file, "IDAT", deflated(std::move(rows)));
    append_chunk(file, "IEND", {});
    return file;
}

std::vector<uint8_t> png_bytes(uint32_t width, uint32_t height, std::span<const Rgb8> pixels) {
    return png_file(width, height, 8, PngColor::rgb, {pixels[0].data(), 3 * pixels.size()});
}

std::vector<uint8_t> jpeg_bytes(uint32_t width, uint32_t height, std::span<const Rgb8> pixels,
                                int quality) {
    std::vector<uint8_t> file;
    const auto append = [](void* context, void* data, int size) {
        const auto* bytes = static_cast<const uint8_t*>(data);
        auto* to = static_cast<std::vector<uint8_t>*>(context);
        to->insert(to->end(), bytes, bytes + size);
    };
    stbi_write_jpg_to_func(append, &file, static_cast<int>(width), static_cast<int>(height), 3,
                           pixels.data(), quality);
    return file;
}

}  // namespace paim
