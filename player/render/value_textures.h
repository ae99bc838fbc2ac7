// Stored values in textures of their own kind: integers stay integers.
#pragma once

#include <span>

#include "paim/codec/stored_values.h"
#include "player/gl/data_texture.h"
#include "player/render/group_gather.h"

namespace paim::player {

// How a list of arrays is shared out between two textures: one of 8-bit integers for the last
// arrays, as far as these hold such, and one of 16-bit integers, or of floats, for those before.
// Components are stored in order of weight, so that small integers are mostly at the end.
struct FormatSplit {
    uint32_t num_int16;     // arrays in the first texture
    gl::TexelFormat int16;  // its format: 32-bit floats where floats and integers meet
};

// floats  the format of floats among themselves
FormatSplit split_by_format(std::span<const StoredValues> arrays, gl::TexelFormat floats);

// The format of one array.
gl::TexelFormat format_of(const StoredValues& values, gl::TexelFormat floats);

// Textures have at least one texel, even of an empty model or of no components.
int64_t at_least_one(int64_t num_texels);

// A texture of the groups 0 … num_groups − 1 that lane_of says, of V vertices each.
gl::DataTexture upload_groups(std::string name, gl::TexelFormat format, int width_log2,
                              uint32_t num_vertices, uint32_t num_groups,
                              const std::function<Lane(uint32_t, uint32_t)>& lane_of);

}  // namespace paim::player
