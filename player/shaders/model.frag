// Gouraud shading: linear radiance, interpolated over the triangle.
in vec3 vertex_radiance;
out vec4 radiance;

void main() { radiance = vec4(vertex_radiance, 1.0); }
