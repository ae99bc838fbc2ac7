// Shades one vertex of the current pose, for transform feedback: radiance = albedo * sum over i of
// transfer_i * light_i, per channel. The codec's shade() computes the sum, which is the radiance of a
// white surface.
// Based on: Sloan, Kautz and Snyder, Precomputed Radiance Transfer, 2002
uniform sampler2D albedo;    // [V] or [1]
uniform int albedo_stride;  // 1, or 0 where one value serves all

out vec3 radiance;
out vec3 white_radiance;

void main() {
    int v = gl_VertexID;
    white_radiance = shade(v);
    radiance = white_radiance * fetch(albedo, v * albedo_stride).rgb;
    gl_Position = vec4(0.0);
}
