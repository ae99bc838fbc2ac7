// The tone-map pass.
#include "player/render/tone_mapper.h"

#include <fmt/format.h>

#include <cmath>

#include "player/shaders/sources.h"

namespace paim::player {

std::string with_tone_curve(std::string_view fragment_source) {
    return fmt::format(
        "const int kReinhard = {};\nconst int kAces = {};\nconst float kLargestExposed = {:e};\n{}"
        "#line 1\n{}",
        static_cast<int>(ToneOperator::reinhard), static_cast<int>(ToneOperator::aces),
        ToneCurve::kLargestExposed, shaders::tone_curve_glsl, fragment_source);
}

void set_tone_curve(const gl::Program& program, const ToneCurve& curve) {
    program.set("tone_scale", std::exp2(curve.exposure_ev));
    program.set("tone_gamma", curve.gamma);
    program.set("tone_operator", static_cast<int>(curve.tone_operator));
}

ToneMapper::ToneMapper()
    : program_("tone map", shaders::fullscreen_vert, with_tone_curve(shaders::tone_map_frag)) {}

void ToneMapper::draw(const gl::Target& picture, int samples, const ToneCurve& curve) const {
    program_.use();
    program_.set_texture("picture", 0, picture.color());
    program_.set("samples", samples);
    set_tone_curve(program_, curve);
    glDisable(GL_DEPTH_TEST);
    triangle_.draw();
}

}  // namespace paim::player
