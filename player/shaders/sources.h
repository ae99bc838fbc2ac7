// The GLSL files of this folder, embedded when Paim is built (embed.cmake). Those of codecs are
// declared in the codecs' folders.
#pragma once

#include <string_view>

namespace paim::player::shaders {

extern const std::string_view vertex_data_glsl;
extern const std::string_view position_vert;
extern const std::string_view radiance_vert;
extern const std::string_view nothing_frag;
extern const std::string_view surface_vert;
extern const std::string_view surface_frag;
extern const std::string_view textured_vert;
extern const std::string_view textured_frag;
extern const std::string_view fullscreen_vert;
extern const std::string_view background_frag;
extern const std::string_view tone_curve_glsl;
extern const std::string_view tone_map_frag;

}  // namespace paim::player::shaders
