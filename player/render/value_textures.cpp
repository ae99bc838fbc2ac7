// Formats and uploading.
#include "player/render/value_textures.h"

#include <algorithm>
#include <utility>

namespace paim::player {

using gl::TexelFormat;

FormatSplit split_by_format(std::span<const StoredValues> arrays, TexelFormat floats) {
    size_t num_int16 = arrays.size();
    while (num_int16 > 0 && arrays[num_int16 - 1].holds_i8()) --num_int16;
    const auto not_int8 = arrays.first(num_int16);
    const auto num_floats =
        std::count_if(not_int8.begin(), not_int8.end(),
                      [](const StoredValues& values) { return values.holds_floats(); });
    const bool all_floats = static_cast<size_t>(num_floats) == num_int16;
    return {static_cast<uint32_t>(num_int16), num_floats == 0 ? TexelFormat::rgba16i
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
    const auto upload_as = [&]<typename Value>(Value) {
        texture.upload([&](int64_t first, std::span<Value> out) {
            gather_groups(num_vertices, lane_of, first, out);
        });
    };
    switch (format) {
        case TexelFormat::r16i:
        case TexelFormat::rgba16i:
            upload_as(int16_t{});
            break;
        case TexelFormat::rgba8i:
            upload_as(int8_t{});
            break;
        default:
            upload_as(float{});
    }
    return texture;
}

}  // namespace paim::player
