// The GLSL files of this folder, embedded when Paim is built (embed.cmake).
#pragma once

#include <string_view>

namespace paim::player::shaders {

extern const std::string_view model_vert;
extern const std::string_view model_frag;
extern const std::string_view fullscreen_vert;
extern const std::string_view background_frag;
extern const std::string_view tone_curve_glsl;
extern const std::string_view tone_map_frag;

}  // namespace paim::player::shaders
