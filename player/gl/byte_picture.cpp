// RGBA8 textures.
#include "player/gl/byte_picture.h"

#include <vector>

#include "paim/base/check.h"
#include "player/gl/check.h"

namespace paim::player::gl {

BytePicture::BytePicture(int width, int height) : width_(width), height_(height) {
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    check_errors("making a picture of a panel");
}

void BytePicture::upload(std::span<const uint8_t> rgb) const {
    const size_t num_pixels = static_cast<size_t>(width_) * static_cast<size_t>(height_);
    PAIM_CHECK_EQ(rgb.size(), 3 * num_pixels);
    std::vector<uint8_t> rgba(4 * num_pixels, 255);
    for (size_t j = 0; j < num_pixels; ++j) {
        for (size_t channel = 0; channel < 3; ++channel) {
            rgba[4 * j + channel] = rgb[3 * j + channel];
        }
    }
    glBindTexture(GL_TEXTURE_2D, texture_.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE,
                    rgba.data());
}

}  // namespace paim::player::gl
