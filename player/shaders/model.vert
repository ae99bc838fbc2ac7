// Rebuilds one vertex of the current pose and shades it: radiance = albedo * sum over i of
// transfer_i * light_i, per channel.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry,
//           2012; Sloan, Kautz and Snyder, Precomputed Radiance Transfer, 2002; Sloan, Hall, Hart
//           and Snyder, Clustered Principal Components for Precomputed Radiance Transfer, 2003
//
// All data lie in 2D textures (player/gl/data_texture.h). A texel holds four values of one vertex.
// Integers count steps, by which the uniforms and the light are multiplied. The last components, as
// far as they are 8-bit integers, are in a texture of these ("int8"), those before them in one of
// 16-bit integers or, where the file holds floats, of floats ("int16"): #defines say which samplers
// these take (player/render/low_rank_textures.h).
// Components:   texel = (k * groups + j) * num_vertices + v, j counting groups of four planes,
//               channel after channel
// Coefficients: texel = j * num_vertices + v, j counting groups of four components of clusters
uniform geometry_mean_sampler geometry_mean;
uniform geometry_int16_sampler geometry_int16;
uniform isampler2D geometry_int8;
uniform sampler2D geometry_weights;  // of all components in use
uniform sampler2D albedo;            // [V] or [1]

uniform int width_log2;  // of every texture
uniform int num_vertices;
uniform int num_geometry_int16;  // components in use
uniform int num_geometry_int8;
uniform int albedo_stride;  // 1, or 0 where one value serves all
uniform vec3 geometry_step;
uniform mat4 clip_from_local;

out vec3 vertex_radiance;

ivec2 place(int texel) { return ivec2(texel & ((1 << width_log2) - 1), texel >> width_log2); }

vec4 fetch(sampler2D data, int texel) { return texelFetch(data, place(texel), 0); }

vec4 fetch(isampler2D data, int texel) { return vec4(texelFetch(data, place(texel), 0)); }

vec4 rebuild_position(int v) {
    vec4 position = fetch(geometry_mean, v);
    for (int k = 0; k < num_geometry_int16; ++k) {
        position += fetch(geometry_weights, k).x * fetch(geometry_int16, k * num_vertices + v);
    }
    for (int k = 0; k < num_geometry_int8; ++k) {
        position += fetch(geometry_weights, num_geometry_int16 + k).x *
                    fetch(geometry_int8, k * num_vertices + v);
    }
    return vec4(geometry_step * position.xyz, 1.0);
}

#ifdef CLUSTERED

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

#else

uniform transfer_mean_sampler transfer_mean;
uniform transfer_int16_sampler transfer_int16;
uniform isampler2D transfer_int8;
uniform sampler2D transfer_weights;
uniform sampler2D light;  // [3][groups], times the steps; zero beyond the bands in use

uniform int num_transfer_int16;  // components in use
uniform int num_transfer_int8;
uniform int num_channels;        // of the transfer, 1 or 3
uniform int groups_per_channel;  // in the textures
uniform int groups_in_use;       // that hold coefficients of the bands in use

// Four transfer coefficients, in steps: those of the group, counted over all channels.
vec4 rebuild_transfer(int group, int v) {
    int texel = group * num_vertices + v;
    int stride = num_channels * groups_per_channel * num_vertices;
    vec4 transfer = fetch(transfer_mean, texel);
    for (int k = 0; k < num_transfer_int16; ++k) {
        transfer += fetch(transfer_weights, k).x * fetch(transfer_int16, k * stride + texel);
    }
    for (int k = 0; k < num_transfer_int8; ++k) {
        transfer += fetch(transfer_weights, num_transfer_int16 + k).x *
                    fetch(transfer_int8, k * stride + texel);
    }
    return transfer;
}

vec4 light_group(int channel, int j) { return fetch(light, channel * groups_per_channel + j); }

vec3 shade(int v) {
    vec3 radiance = vec3(0.0);
    for (int j = 0; j < groups_in_use; ++j) {
        vec4 red = rebuild_transfer(j, v);
        vec4 green = red;
        vec4 blue = red;
        if (num_channels == 3) {
            green = rebuild_transfer(groups_per_channel + j, v);
            blue = rebuild_transfer(2 * groups_per_channel + j, v);
        }
        radiance += vec3(dot(red, light_group(0, j)), dot(green, light_group(1, j)),
                         dot(blue, light_group(2, j)));
    }
    return radiance;
}

#endif

void main() {
    int v = gl_VertexID;
    vertex_radiance = shade(v) * fetch(albedo, v * albedo_stride).rgb;
    gl_Position = clip_from_local * rebuild_position(v);
}
