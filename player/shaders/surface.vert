// A vertex of a surface: its position and its colour are attributes. pass_gloss() is that of
// player/render/gloss_shader.h.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 color;

uniform mat4 clip_from_local;

invariant gl_Position;  // faces with and without images meet without gaps

out vec3 vertex_color;

void main() {
    vertex_color = color;
    pass_gloss(gl_VertexID, position);
    gl_Position = clip_from_local * vec4(position, 1.0);
}
