// A picture of eight bits a channel, as panels show it.
#pragma once

#include <cstdint>
#include <span>

#include "player/gl/handle.h"

namespace paim::player::gl {

class BytePicture {
  public:
    BytePicture(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    const TextureHandle& texture() const { return texture_; }

    // rgb  [height][width][3], row 0 on top
    void upload(std::span<const uint8_t> rgb) const;

  private:
    int width_, height_;
    TextureHandle texture_;
};

}  // namespace paim::player::gl
