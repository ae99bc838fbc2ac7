// The images of a texture on the GPU, with all their levels.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/base/vector.h"
#include "paim/mesh/texture.h"
#include "player/gl/handle.h"

namespace paim::player {

class ImageTextures {
  public:
    // Decodes and uploads all images. Levels larger than this driver's largest texture are left out.
    // Errors: bad input, those of make_pyramids(); unsupported, not enough memory.
    explicit ImageTextures(const Texture& texture);

    struct Image {
        gl::TextureHandle handle;  // sRGB; samples are linear
        int num_levels = 0;
        Vec3f factor;  // of its colours
    };
    const Image& image(size_t number) const { return images_[number]; }
    uint64_t size_bytes() const { return size_bytes_; }

  private:
    std::vector<Image> images_;
    uint64_t size_bytes_ = 0;
};

}  // namespace paim::player
