// A program that draws into pictures of linear radiance, or of display values.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "paim/image/tone.h"
#include "player/gl/program.h"

namespace paim::player {

class PictureProgram {
  public:
    // The fragment shader writes shown(radiance) for what it has as linear radiance.
    // Errors: those of gl::Program.
    PictureProgram(const std::string& name, std::string_view vertex_source,
                   std::string_view fragment_source);

    // Puts the program in use that draws through this curve, or linear radiance without one.
    const gl::Program& use(const std::optional<ToneCurve>& curve) const;

  private:
    gl::Program linear_, displayed_;
};

}  // namespace paim::player
