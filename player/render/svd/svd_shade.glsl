// Codec svd: rebuilds the transfer of a vertex and lights it.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry,
//           2012
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

