// GLSL that shows gloss: outgoing coefficients of vertices, and the direction of the eye.
#pragma once

#include <cstdint>
#include <string>

#include "player/render/frame.h"

namespace paim::player {

// What shaders of a surface with gloss are given.
struct GlossShader {
    GlossDetail detail = GlossDetail::none;
    uint32_t out_bands = 1;

    bool operator<(const GlossShader& other) const {
        return detail != other.detail ? detail < other.detail : out_bands < other.out_bands;
    }
};

// Goes in front of the vertex shader: pass_gloss(vertex, position) is called once.
//   uniform sampler2D exits       texel o · num_rows + row: coefficient o of a row, linear RGB
//   uniform sampler2D rows        texel v: the row of vertex v, −1 if it has none
//   uniform int num_rows, gloss_width_log2
//   uniform vec3 local_eye        in the coordinates of the position
std::string gloss_vertex_source(const GlossShader& shader);

// Goes in front of the fragment shader: gloss_radiance() is the linear radiance of the pixel.
std::string gloss_fragment_source(const GlossShader& shader);

// The most bands of outgoing radiance that pixels can interpolate with this driver.
uint32_t most_out_bands_at_pixels();

}  // namespace paim::player
