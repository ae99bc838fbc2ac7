// Gouraud shading: linear radiance, interpolated over the triangle; or edges in one colour. shown() is that of
// player/render/picture_program.h, gloss_radiance() that of player/render/gloss_shader.h.
uniform vec4 edge_color;  // alpha 1: instead of the vertices' colours; 0: not at all

in vec3 vertex_color;
out vec4 color;

void main() {
    vec3 radiance = vertex_color + gloss_radiance();
    color = vec4(shown(mix(radiance, edge_color.rgb, edge_color.a)), 1.0);
}
