// Shows a picture of linear radiance on the screen, as ToneCurve does for files.
#pragma once

#include "paim/image/tone.h"
#include "player/gl/fullscreen.h"
#include "player/gl/program.h"
#include "player/gl/target.h"

namespace paim::player {

class ToneMapper {
  public:
    ToneMapper();

    // Draws over all of the current framebuffer, which is the picture's size divided by `samples`:
    // samples × samples texels of the picture are averaged for each pixel.
    void draw(const gl::Target& picture, int samples, const ToneCurve& curve) const;

  private:
    gl::Program program_;
    gl::FullscreenTriangle triangle_;
};

}  // namespace paim::player
