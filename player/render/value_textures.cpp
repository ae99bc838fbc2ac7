// Formats and uploading.
#include "player/render/value_textures.h"

#include <algorithm>
#include <utility>

namespace paim::player {

using gl::TexelFormat;

FormatSplit split_by_format(std::span<const StoredValues> arrays, TexelFormat floats) {
    size_t num_wide = arrays.size();
    while (num_wide > 0 && arrays[num_wide - 1].holds_i8()) --num_wide;
    const auto wide = arrays.first(num_wide);
    const auto num_floats = std::count_if(
        wide.begin(), wide.end(), [](const StoredValues& values) { return values.holds_floats(); });
    const bool all_floats = static_cast<size_t>(num_floats) == num_wide;
    return {static_cast<uint32_t>(num_wide), num_floats == 0 ? TexelFormat::rgba16i
                                             : all_floats    ? floats
                                                             : TexelFormat::rgba32f};
}

TexelFormat format_of(const StoredValues& values, TexelFormat floats) {
    if (values.holds_floats()) return floats;
    return values.holds_i8() ? TexelFormat::rgba8i : TexelFormat::rgba16i;
}

int64_t at_least_one(int64_t num_texels) {
    return std::max<int64_t>(1, num_texels);
}

gl::DataTexture upload_groups(std::string name, TexelFormat format, int width_log2,
                              uint32_t num_vertices, uint32_t num_groups,
                              const std::function<Lane(uint32_t, uint32_t)>& lane_of) {
    const int64_t num_texels = int64_t{num_groups} * num_vertices;
    gl::DataTexture texture(std::move(name), format, width_log2, at_least_one(num_texels));
    if (num_texels == 0) return texture;
    texture.upload([&](int64_t first, std::span<float> out) {
        gather_groups(num_vertices, lane_of, first, out);
    });
    return texture;
}

}  // namespace paim::player
