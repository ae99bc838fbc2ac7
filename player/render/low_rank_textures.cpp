// Uploading a matrix.
#include "player/render/low_rank_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paim/codec/rebuild_planes.h"
#include "player/render/value_textures.h"

namespace paim::player {

namespace {

using gl::DataTexture;
using gl::TexelFormat;

FormatSplit split_of(const LowRank& matrix, uint32_t num_components) {
    const TexelFormat floats =
        matrix.precision == Precision::f16 ? TexelFormat::rgba16f : TexelFormat::rgba32f;
    return split_by_format(std::span(matrix.components).first(num_components), floats);
}

DataTexture upload_mean(const std::string& name, const LowRank& matrix, const PlaneGroups& planes,
                        int width_log2) {
    return upload_groups(
        fmt::format("the mean {}", name), format_of(matrix.mean, TexelFormat::rgba32f), width_log2,
        planes.num_vertices, planes.num_groups(),
        [&](uint32_t group, uint32_t lane) { return planes.lane(matrix.mean, group, lane); });
}

// Components [begin, end).
DataTexture upload_components(const std::string& name, const LowRank& matrix,
                              const PlaneGroups& planes, uint32_t begin, uint32_t end,
                              TexelFormat format, int width_log2) {
    const uint32_t stride = planes.num_groups();
    return upload_groups(
        fmt::format("the {} components", name), format, width_log2, planes.num_vertices,
        (end - begin) * stride, [&](uint32_t group, uint32_t lane) {
            const StoredValues& component = matrix.components[begin + group / stride];
            return planes.lane(component, group % stride, lane);
        });
}

}  // namespace

LowRankTextures::LowRankTextures(std::string name, const LowRank& matrix, const PlaneGroups& planes,
                                 uint32_t num_components, int width_log2)
    : name_(std::move(name)),
      matrix_(matrix),
      num_components_(num_components),
      num_int16_(split_of(matrix, num_components).num_int16),
      mean_(upload_mean(name_, matrix, planes, width_log2)),
      int16_(upload_components(name_, matrix, planes, 0, num_int16_,
                               split_of(matrix, num_components).int16, width_log2)),
      int8_(upload_components(name_, matrix, planes, num_int16_, num_components,
                              TexelFormat::rgba8i, width_log2)),
      weights_(fmt::format("the {} weights", name_), TexelFormat::r32f, width_log2,
               at_least_one(num_components)) {}

std::string LowRankTextures::defines() const {
    return fmt::format("#define {0}_mean_sampler {1}\n#define {0}_int16_sampler {2}\n", name_,
                       gl::sampler_type(mean_.format()), gl::sampler_type(int16_.format()));
}

uint64_t LowRankTextures::size_bytes() const {
    return mean_.size_bytes() + int16_.size_bytes() + int8_.size_bytes() + weights_.size_bytes();
}

int LowRankTextures::bind(const gl::Program& program, int unit, double time,
                          uint32_t num_components) {
    interpolate_weights(matrix_, time, scratch_);
    scratch_.resize(std::min<size_t>(scratch_.size(), num_components_));
    weights_.update(scratch_);

    const auto set_texture = [&](const char* what, const DataTexture& texture) {
        program.set_texture((name_ + what).c_str(), unit++, texture.handle());
    };
    set_texture("_mean", mean_);
    set_texture("_int16", int16_);
    set_texture("_int8", int8_);
    set_texture("_weights", weights_);
    const uint32_t used = std::min(num_components, num_components_);
    const uint32_t used_int16 = std::min(used, num_int16_);
    program.set(("num_" + name_ + "_int16").c_str(), static_cast<int>(used_int16));
    program.set(("num_" + name_ + "_int8").c_str(), static_cast<int>(used - used_int16));
    return unit;
}

}  // namespace paim::player
