// One image after the other, within what is left of the pixels.
#include "paim/image/texture_pyramids.h"

#include <utility>

namespace paim {

std::vector<MipPyramid> make_pyramids(std::span<const TextureImage> images, int64_t max_pixels) {
    std::vector<MipPyramid> pyramids;
    int64_t left = max_pixels;
    for (const TextureImage& image : images) {
        DecodedTexture decoded = decode_texture(image.bytes, image.name, left);
        left -= static_cast<int64_t>(decoded.pixels.size());
        pyramids.emplace_back(std::move(decoded));
    }
    return pyramids;
}

}  // namespace paim
