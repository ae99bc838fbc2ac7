// A floating-point picture with depth to draw into.
#pragma once

#include "paim/image/image.h"
#include "player/gl/handle.h"

namespace paim::player::gl {

enum class TargetKind {
    radiance,  // linear, RGBA32F (RGBA16F where the driver cannot draw into that)
    display,   // display values, RGBA8
};

// Colours and 32-bit float depth.
class Target {
  public:
    // Throws Error(unsupported) if the driver's largest target is smaller, or memory does not
    // suffice.
    Target(int width, int height, TargetKind kind = TargetKind::radiance);

    int width() const { return width_; }
    int height() const { return height_; }
    TargetKind kind() const { return kind_; }
    const TextureHandle& color() const { return color_; }

    // Draws go here from now on, over all of it.
    void bind() const;

    // The picture as it is, row 0 on top.
    Image read() const;

    // Copies display values to the window's framebuffer, which has the same size.
    void show() const;

  private:
    bool complete_with(GLint color_format) const;

    int width_;
    int height_;
    TargetKind kind_;
    TextureHandle color_;
    RenderbufferHandle depth_;
    FramebufferHandle framebuffer_;
};

// Fills what is drawn into, as far as no scissor keeps it, with a colour and the farthest depth.
void clear(const Vec3f& color);

}  // namespace paim::player::gl
