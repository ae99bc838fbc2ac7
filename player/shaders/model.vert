// Rebuilds one vertex of the current pose, position and transfer, as mean + components * weights,
// and shades it: radiance = albedo * sum over i of transfer_i * light_i, per channel.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming Geometry,
//           2012; Sloan, Kautz and Snyder, Precomputed Radiance Transfer, 2002
//
// All data lie in 2D textures (player/gl/data_texture.h). A texel holds four coefficients of one
// vertex; texel = (k * planes + j) * num_vertices + v, j counting groups of four coefficients,
// channel after channel.
uniform sampler2D geometry_mean;
uniform sampler2D geometry_components;
uniform sampler2D geometry_weights;
uniform sampler2D transfer_mean;
uniform sampler2D transfer_components;
uniform sampler2D transfer_weights;
uniform sampler2D light;   // [3][groups], zero beyond the bands in use
uniform sampler2D albedo;  // [V] or [1]

uniform int width_log2;  // of every texture
uniform int num_vertices;
uniform int num_geometry_components;  // in use
uniform int num_transfer_components;  // in use
uniform int num_channels;             // of the transfer, 1 or 3
uniform int groups_per_channel;       // in the textures
uniform int groups_in_use;            // that hold coefficients of the bands in use
uniform int albedo_stride;            // 1, or 0 where one value serves all
uniform mat4 clip_from_world;

out vec3 vertex_radiance;

vec4 fetch(sampler2D data, int texel) {
    return texelFetch(data, ivec2(texel & ((1 << width_log2) - 1), texel >> width_log2), 0);
}

vec4 rebuild_position(int v) {
    vec4 position = fetch(geometry_mean, v);
    for (int k = 0; k < num_geometry_components; ++k) {
        position += fetch(geometry_weights, k).x *
                    fetch(geometry_components, k * num_vertices + v);
    }
    return vec4(position.xyz, 1.0);
}

// Four transfer coefficients: those of the group, counted over all channels.
vec4 rebuild_transfer(int group, int v) {
    int texel = group * num_vertices + v;
    int stride = num_channels * groups_per_channel * num_vertices;
    vec4 transfer = fetch(transfer_mean, texel);
    for (int k = 0; k < num_transfer_components; ++k) {
        transfer += fetch(transfer_weights, k).x * fetch(transfer_components, k * stride + texel);
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
    return radiance * fetch(albedo, v * albedo_stride).rgb;
}

void main() {
    vertex_radiance = shade(gl_VertexID);
    gl_Position = clip_from_world * rebuild_position(gl_VertexID);
}
