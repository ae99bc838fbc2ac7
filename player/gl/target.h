// A floating-point picture with depth to draw into.
#pragma once

#include "paim/image/image.h"
#include "player/gl/handle.h"

namespace paim::player::gl {

// Linear radiance, RGBA32F (RGBA16F where the driver cannot draw into that), 32-bit float depth.
class Target {
  public:
    // Throws Error(unsupported) if the driver's largest target is smaller, or memory does not
    // suffice.
    Target(int width, int height);

    int width() const { return width_; }
    int height() const { return height_; }
    const TextureHandle& color() const { return color_; }

    // Draws go here from now on, over all of it.
    void bind() const;

    // The picture as it is, row 0 on top.
    Image read() const;

  private:
    bool complete_with(GLint color_format) const;

    int width_;
    int height_;
    TextureHandle color_;
    RenderbufferHandle depth_;
    FramebufferHandle framebuffer_;
};

}  // namespace paim::player::gl
