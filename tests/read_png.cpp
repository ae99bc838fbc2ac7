// PNG through stb_image.
#include "tests/read_png.h"

#include <cstring>
#include <memory>
#include <stdexcept>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpragmas"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb_image.h>
#pragma GCC diagnostic pop

namespace paim {

PngPicture read_png(const std::filesystem::path& path) {
    PngPicture picture;
    int channels = 0;
    const std::unique_ptr<unsigned char, void (*)(void*)> values(
        stbi_load(path.c_str(), &picture.width, &picture.height, &channels, 0), stbi_image_free);
    if (values == nullptr || channels != 3) {
        throw std::runtime_error(path.string() + ": not a PNG of 8-bit RGB");
    }
    picture.pixels.resize(static_cast<size_t>(picture.width) * static_cast<size_t>(picture.height));
    std::memcpy(picture.pixels.data(), values.get(), 3 * picture.pixels.size());
    return picture;
}

}  // namespace paim
