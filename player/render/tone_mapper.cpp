// The tone-map pass.
#include "player/render/tone_mapper.h"

#include <cmath>

#include "player/shaders/sources.h"

namespace paim::player {

ToneMapper::ToneMapper() : program_("tone map", shaders::fullscreen_vert, shaders::tone_map_frag) {}

void ToneMapper::draw(const gl::Target& picture, int samples, const ToneCurve& curve) const {
    program_.use();
    program_.set_texture("picture", 0, picture.color());
    program_.set("samples", samples);
    program_.set("scale", std::exp2(curve.exposure_ev));
    program_.set("gamma", curve.gamma);
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

}  // namespace paim::player
