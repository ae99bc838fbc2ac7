// A triangle that covers the screen, on the far plane, from gl_VertexID alone. image_position runs from (0, 0) at the
// lower left to (1, 1) at the upper right corner of the target.
out vec2 image_position;

void main() {
    image_position = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
    gl_Position = vec4(2.0 * image_position - 1.0, 1.0, 1.0);
}
