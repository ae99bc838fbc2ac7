// Fills the picture with what is behind the mesh.
#pragma once

#include <optional>

#include "paim/light/environment.h"
#include "player/gl/data_texture.h"
#include "player/gl/fullscreen.h"
#include "player/render/frame.h"
#include "player/render/picture_program.h"

namespace paim::player {

class BackgroundRenderer {
  public:
    BackgroundRenderer();

    // The lat-long map to show from now on. Maps of few pixels are made smooth
    // (smooth_if_small()). One larger than this driver's textures is averaged down until it fits.
    void set_environment(const EnvironmentLight& environment);

    // Clears colour and depth of the current target; before the mesh is drawn.
    void clear(const Frame& frame) const;

    // Draws the environment, if the frame shows it, where there is no mesh.
    // aspect  of the whole picture
    void draw(const Frame& frame, float aspect);

  private:
    PictureProgram program_;
    gl::FullscreenTriangle triangle_;
    gl::TextureHandle sharp_, blurred_;
    std::optional<EnvironmentLight> to_blur_;  // empty: blurred_ is up to date
};

}  // namespace paim::player
