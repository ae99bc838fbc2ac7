// Shows a picture of linear radiance on the screen, as ToneCurve does for files.
#pragma once

#include <string>
#include <string_view>

#include "paim/image/tone.h"
#include "player/gl/fullscreen.h"
#include "player/gl/program.h"
#include "player/gl/target.h"

namespace paim::player {

// The fragment shader behind shaders/tone_curve.glsl, whose function tone_curve(radiance) it may call.
std::string with_tone_curve(std::string_view fragment_source);

// Sets the curve of a program that has such a fragment shader and is in use.
void set_tone_curve(const gl::Program& program, const ToneCurve& curve);

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
