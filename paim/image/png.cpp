// PNG through stb_image_write: encoded in memory, so that the file appears whole or not at all.
#include "paim/image/png.h"

#include <climits>
#include <vector>

#include "paim/base/error.h"
#include "paim/base/file.h"

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

void write_png(const std::filesystem::path& path, const Image& image, const ToneCurve& curve) {
    PAIM_CHECK_LE(1, image.width);
    PAIM_CHECK_LE(1, image.height);
    // stb counts bytes in an int, with one filter byte for each row.
    if ((3LL * image.width + 1) * image.height > INT_MAX / 2) {
        throw_output_failed("{}: {} x {} pixels, expected fewer for a PNG", path.string(),
                            image.width, image.height);
    }
    const auto display = tone_map(image, curve);
    std::vector<char> encoded;
    const auto append = [](void* context, void* data, int size_bytes) {
        const char* bytes = static_cast<const char*>(data);
        static_cast<std::vector<char>*>(context)->insert(
            static_cast<std::vector<char>*>(context)->end(), bytes, bytes + size_bytes);
    };
    if (stbi_write_png_to_func(append, &encoded, image.width, image.height, 3, display.data(),
                               3 * image.width) == 0) {
        throw_output_failed("{}: cannot encode {} x {} pixels as PNG", path.string(), image.width,
                            image.height);
    }
    AtomicFile file(path);
    file.write(encoded.data(), encoded.size());
    file.commit();
}

}  // namespace paim
