// PNG and JPEG through stb_image, whose memory is bounded.
#include "paim/image/texture_image.h"

#include <algorithm>
#include <array>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "paim/base/check.h"
#include "paim/base/error.h"

namespace paim {

namespace {

// No block of memory of the decoder may be larger. stb_image checks headers, but inflates as much
// as a PNG file holds.
thread_local size_t max_block_bytes = 0;

void* allocate_block(size_t size_bytes) {
    return size_bytes <= max_block_bytes ? std::malloc(size_bytes) : nullptr;
}

void* reallocate_block(void* block, size_t size_bytes) {
    return size_bytes <= max_block_bytes ? std::realloc(block, size_bytes) : nullptr;
}

}  // namespace

}  // namespace paim

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_MALLOC(size) paim::allocate_block(size)
#define STBI_REALLOC(block, size) paim::reallocate_block(block, size)
#define STBI_FREE(block) std::free(block)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wuseless-cast"
#pragma GCC diagnostic ignored "-Wcast-align"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wduplicated-branches"
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace paim {

namespace {

constexpr size_t kHeaderBytes = size_t{1} << 20;  // for all that no size of the image counts for

bool starts_with(std::span<const uint8_t> bytes, std::span<const uint8_t> start) {
    return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

bool is_jpeg(std::span<const uint8_t> bytes) {
    static constexpr std::array<uint8_t, 3> kStart{0xff, 0xd8, 0xff};
    return starts_with(bytes, kStart);
}

bool is_png(std::span<const uint8_t> bytes) {
    static constexpr std::array<uint8_t, 8> kStart{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    return starts_with(bytes, kStart);
}

// Whether a JPEG file has an end marker after its last scan: stb_image fills what is missing with
// grey. Neither marker appears in the data of a scan.
bool ends(std::span<const uint8_t> bytes) {
    static constexpr std::array<uint8_t, 2> kScan{0xff, 0xda}, kEnd{0xff, 0xd9};
    const auto last = [&](const std::array<uint8_t, 2>& marker) {
        return std::find_end(bytes.begin(), bytes.end(), marker.begin(), marker.end());
    };
    const auto end = last(kEnd);
    return end != bytes.end() && last(kScan) < end;
}

// The largest block that decoding an image takes. Inflated rows of a PNG file have up to four channels
// of 16 bits and a byte in front, and are doubled where an interlaced file has more of them than
// stb_image expects. Coefficients of a JPEG file have 16 bits in squares of up to 32 pixels. The
// file's own data are gathered in a block that doubles, too.
size_t largest_block(int width, int height, size_t file_bytes) {
    const auto columns = static_cast<size_t>(width), rows = static_cast<size_t>(height);
    return kHeaderBytes + 2 * file_bytes + 20 * columns * rows + 64 * (columns + rows);
}

[[noreturn]] void refuse(std::string_view name, const char* reason) {
    throw_bad_input("{}: truncated or damaged image ({})", name, reason);
}

}  // namespace

DecodedTexture decode_texture(std::span<const uint8_t> bytes, std::string_view name,
                              int64_t max_pixels) {
    PAIM_CHECK_LE(1, max_pixels);
    if (!is_png(bytes) && !is_jpeg(bytes)) {
        throw_bad_input("{}: neither a PNG nor a JPEG image", name);
    }
    if (bytes.size() > INT_MAX / 4) {  // stb_image counts bytes in an int
        throw_bad_input("{}: {} bytes, expected at most {}", name, bytes.size(), INT_MAX / 4);
    }
    if (is_jpeg(bytes) && !ends(bytes)) throw_bad_input("{}: truncated JPEG image", name);
    const int num_bytes = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    max_block_bytes = kHeaderBytes;
    if (stbi_info_from_memory(bytes.data(), num_bytes, &width, &height, &channels) == 0) {
        refuse(name, "header");
    }
    if (int64_t{width} * height > max_pixels) {
        throw_bad_input("{}: {} x {} pixels, expected at most {}", name, width, height, max_pixels);
    }
    max_block_bytes = largest_block(width, height, bytes.size());
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(bytes.data(), num_bytes, &width, &height, &channels, 3),
        stbi_image_free);
    if (pixels == nullptr) refuse(name, stbi_failure_reason());
    DecodedTexture texture{width, height, {}};
    texture.pixels.resize(static_cast<size_t>(width) * static_cast<size_t>(height));
    std::memcpy(texture.pixels.data(), pixels.get(), texture.pixels.size() * sizeof(Rgb8));
    return texture;
}

}  // namespace paim
