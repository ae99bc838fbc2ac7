// GLSL that shows gloss.
// Based on: Peter-Pike Sloan, Efficient Spherical Harmonic Evaluation, 2013 (the recurrences of
//           paim/sh/recurrence.h)
#include "player/render/gloss_shader.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <cmath>

#include "paim/base/vector.h"
#include "paim/sh/index.h"
#include "paim/sh/recurrence.h"

namespace paim::player {

namespace {

// The basis of a unit direction d as statements that set y[0 …].
std::string basis_statements(int bands) {
    std::string text = "    float c = 1.0, s = 0.0, t, q, q1, q2;\n";
    double diagonal = std::sqrt(1.0 / (4.0 * kPi));
    for (int m = 0; m < bands; ++m) {
        if (m > 0) {
            text += "    t = d.x * c - d.y * s; s = d.x * s + d.y * c; c = t;\n";
            diagonal *= sh::diagonal_ratio(m);
        }
        text += fmt::format("    q2 = 0.0; q1 = 0.0; q = {:.9e};\n", diagonal);
        for (int l = m; l < bands; ++l) {
            if (l > m) {
                const sh::LegendreStep step = sh::legendre_step(l, m);
                text += fmt::format("    q2 = q1; q1 = q; q = {:.9e} * d.z * q1 - {:.9e} * q2;\n",
                                    step.a, step.b);
            }
            text += fmt::format("    y[{}] = q * c;\n", l * (l + 1) + m);
            if (m > 0) text += fmt::format("    y[{}] = q * s;\n", l * (l + 1) - m);
        }
    }
    return text;
}

std::string basis_source(uint32_t out_bands) {
    const int bands = static_cast<int>(out_bands);
    return fmt::format(
               "const int kOutgoing = {};\nvoid outgoing_basis(vec3 d, out float y[{}]) {{\n",
               sh::num_coefficients(bands), sh::num_coefficients(bands)) +
           basis_statements(bands) + "}\n";
}

constexpr const char* kFetch =
    "uniform sampler2D exits;\n"
    "uniform sampler2D rows;\n"
    "uniform int num_rows;\n"
    "uniform int gloss_width_log2;\n"
    "uniform vec3 local_eye;\n"
    "ivec2 gloss_place(int texel) {\n"
    "    return ivec2(texel & ((1 << gloss_width_log2) - 1), texel >> gloss_width_log2);\n"
    "}\n"
    "int gloss_row(int vertex) { return int(texelFetch(rows, gloss_place(vertex), 0).r); }\n"
    "vec3 exit_of(int o, int row) {\n"
    "    return texelFetch(exits, gloss_place(o * num_rows + row), 0).rgb;\n"
    "}\n";

}  // namespace

std::string gloss_vertex_source(const GlossShader& shader) {
    if (shader.detail == GlossDetail::none) {
        return "void pass_gloss(int vertex, vec3 position) {}\n";
    }
    const std::string begin = basis_source(shader.out_bands) + kFetch;
    if (shader.detail == GlossDetail::vertex) {
        return begin +
               "out vec3 vertex_gloss;\n"
               "void pass_gloss(int vertex, vec3 position) {\n"
               "    vertex_gloss = vec3(0.0);\n"
               "    int row = gloss_row(vertex);\n"
               "    if (row < 0) return;\n"
               "    float y[kOutgoing];\n"
               "    outgoing_basis(normalize(local_eye - position), y);\n"
               "    for (int o = 0; o < kOutgoing; ++o) vertex_gloss += y[o] * exit_of(o, row);\n"
               "}\n";
    }
    return begin +
           "out vec3 exit[kOutgoing];\n"
           "out vec3 towards_eye;\n"
           "void pass_gloss(int vertex, vec3 position) {\n"
           "    towards_eye = local_eye - position;\n"
           "    int row = gloss_row(vertex);\n"
           "    for (int o = 0; o < kOutgoing; ++o) {\n"
           "        exit[o] = row < 0 ? vec3(0.0) : exit_of(o, row);\n"
           "    }\n"
           "}\n";
}

std::string gloss_fragment_source(const GlossShader& shader) {
    switch (shader.detail) {
        case GlossDetail::none:
            return "vec3 gloss_radiance() { return vec3(0.0); }\n";
        case GlossDetail::vertex:
            return "in vec3 vertex_gloss;\n"
                   "vec3 gloss_radiance() { return vertex_gloss; }\n";
        case GlossDetail::pixel:
            break;
    }
    return basis_source(shader.out_bands) +
           "in vec3 exit[kOutgoing];\n"
           "in vec3 towards_eye;\n"
           "vec3 gloss_radiance() {\n"
           "    float y[kOutgoing];\n"
           "    outgoing_basis(normalize(towards_eye), y);\n"
           "    vec3 radiance = vec3(0.0);\n"
           "    for (int o = 0; o < kOutgoing; ++o) radiance += y[o] * exit[o];\n"
           "    return radiance;\n"
           "}\n";
}

uint32_t most_out_bands_at_pixels() {
    GLint components = 0;
    glGetIntegerv(GL_MAX_VARYING_COMPONENTS, &components);
    // A vector of three takes four components; other outputs of the shaders take at most six.
    uint32_t bands = 1;
    const auto needed = [](uint32_t n) { return 4 * static_cast<int>(n * n) + 6 * 4; };
    while (needed(bands + 1) <= components) ++bands;
    return bands;
}

}  // namespace paim::player
