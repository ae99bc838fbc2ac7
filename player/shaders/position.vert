// Rebuilds the position of one vertex of the current pose, for transform feedback.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry,
//           2012
uniform geometry_mean_sampler geometry_mean;
uniform geometry_int16_sampler geometry_int16;
uniform isampler2D geometry_int8;
uniform sampler2D geometry_weights;  // of all components in use

uniform int num_geometry_int16;  // components in use
uniform int num_geometry_int8;
uniform vec3 geometry_step;

out vec3 position;

void main() {
    int v = gl_VertexID;
    vec4 sum = fetch(geometry_mean, v);
    for (int k = 0; k < num_geometry_int16; ++k) {
        sum += fetch(geometry_weights, k).x * fetch(geometry_int16, k * num_vertices + v);
    }
    for (int k = 0; k < num_geometry_int8; ++k) {
        sum += fetch(geometry_weights, num_geometry_int16 + k).x *
               fetch(geometry_int8, k * num_vertices + v);
    }
    position = geometry_step * sum.xyz;
    gl_Position = vec4(0.0);
}
