// Uploading levels that were made on the CPU, so that reference pictures have the same ones.
#include "player/render/image_textures.h"

#include <algorithm>
#include <span>

#include "paim/image/texture_pyramids.h"
#include "player/gl/check.h"

namespace paim::player {

namespace {

// Shaders choose levels (shaders/textured.frag), so that no filter between levels is set.
void upload(const gl::TextureHandle& handle, std::span<const DecodedTexture> levels) {
    glBindTexture(GL_TEXTURE_2D, handle.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, static_cast<GLint>(levels.size()) - 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (size_t i = 0; i < levels.size(); ++i) {
        glTexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_SRGB8, levels[i].width,
                     levels[i].height, 0, GL_RGB, GL_UNSIGNED_BYTE, levels[i].pixels.data());
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl::check_errors("uploading an image");
}

}  // namespace

ImageTextures::ImageTextures(const Texture& texture) {
    const int max_size = gl::max_texture_size();
    const std::vector<MipPyramid> pyramids = make_pyramids(texture.images);
    for (size_t i = 0; i < pyramids.size(); ++i) {
        std::span<const DecodedTexture> levels = pyramids[i].levels();
        while (std::max(levels[0].width, levels[0].height) > max_size) levels = levels.subspan(1);
        Image& image = images_.emplace_back();
        image.num_levels = static_cast<int>(levels.size());
        image.factor = texture.factors[i];
        upload(image.handle, levels);
        for (const DecodedTexture& level : levels)
            size_bytes_ += level.pixels.size() * sizeof(Rgb8);
    }
}

}  // namespace paim::player
