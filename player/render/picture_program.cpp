// The two programs.
#include "player/render/picture_program.h"

#include "player/render/tone_mapper.h"

namespace paim::player {

PictureProgram::PictureProgram(const std::string& name, std::string_view vertex_source,
                               std::string_view fragment_source)
    : linear_(name, vertex_source, fragment_source, "#define shown(radiance) (radiance)\n"),
      displayed_(name + ", displayed", vertex_source, with_tone_curve(fragment_source),
                 "#define shown(radiance) tone_curve(radiance)\n") {}

const gl::Program& PictureProgram::use(const std::optional<ToneCurve>& curve) const {
    const gl::Program& program = curve ? displayed_ : linear_;
    program.use();
    if (curve) set_tone_curve(program, *curve);
    return program;
}

}  // namespace paim::player
