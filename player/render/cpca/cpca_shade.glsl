// Codec cpca: the sum of a vertex over the lit basis of its cluster.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
uniform isampler2D cluster;  // [V]
uniform coefficients_int16_sampler coefficients_int16;
uniform isampler2D coefficients_int8;
// [clusters][product_texels]: the mean's product with the light, then the red, green and blue
// products of every four components, zero beyond those in use.
uniform sampler2D basis_radiance;

uniform int product_texels;
uniform int num_int16_groups;  // in use
uniform int num_int8_groups;

// Products of four components, each with its coefficient.
vec3 weigh(vec4 coefficients, int texel) {
    return vec3(dot(coefficients, fetch(basis_radiance, texel)),
                dot(coefficients, fetch(basis_radiance, texel + 1)),
                dot(coefficients, fetch(basis_radiance, texel + 2)));
}

vec3 shade(int v) {
    int texel = texelFetch(cluster, place(v), 0).x * product_texels;
    vec3 radiance = fetch(basis_radiance, texel).rgb;
    ++texel;
    for (int j = 0; j < num_int16_groups; ++j) {
        radiance += weigh(fetch(coefficients_int16, j * num_vertices + v), texel);
        texel += 3;
    }
    for (int j = 0; j < num_int8_groups; ++j) {
        radiance += weigh(fetch(coefficients_int8, j * num_vertices + v), texel);
        texel += 3;
    }
    return radiance;
}

