// Gouraud shading: linear radiance, interpolated over the triangle; or edges in one colour.
uniform vec4 edge_color;  // alpha 1: instead of the vertices' colours; 0: not at all

in vec3 vertex_color;
out vec4 radiance;

void main() { radiance = vec4(mix(vertex_color, edge_color.rgb, edge_color.a), 1.0); }
