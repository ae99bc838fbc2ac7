// Uploading arrays as 2D textures.
#include "player/gl/data_texture.h"

#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/check.h"

namespace paim::player::gl {

namespace {

// The unit where a texture is bound to be written. Programs read from lower units, whose bindings
// stay as they are. OpenGL 3.3 and OpenGL ES 3.0 have 32 units at least.
constexpr GLenum kUploadUnit = GL_TEXTURE31;

struct Format {
    GLint internal;
    GLenum external;
    GLenum type;
    int values;  // of a texel
    int bytes;
};

Format gl_format(TexelFormat format) {
    switch (format) {
        case TexelFormat::r32f:
            return {GL_R32F, GL_RED, GL_FLOAT, 1, 4};
        case TexelFormat::rgb32f:
            return {GL_RGB32F, GL_RGB, GL_FLOAT, 3, 12};
        case TexelFormat::rgba16f:
            return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 4, 8};
        case TexelFormat::r16i:
            return {GL_R16I, GL_RED_INTEGER, GL_SHORT, 1, 2};
        case TexelFormat::rgba16i:
            return {GL_RGBA16I, GL_RGBA_INTEGER, GL_SHORT, 4, 8};
        case TexelFormat::rgba8i:
            return {GL_RGBA8I, GL_RGBA_INTEGER, GL_BYTE, 4, 4};
        case TexelFormat::rgba32f:
            break;
    }
    return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 4, 16};
}

// Whether values of this type fill a texture of the format.
template <typename Value>
bool fits(TexelFormat format) {
    const GLenum type = gl_format(format).type;
    if (std::is_same_v<Value, int16_t>) return type == GL_SHORT;
    if (std::is_same_v<Value, int8_t>) return type == GL_BYTE;
    return type == GL_FLOAT || type == GL_HALF_FLOAT;
}

std::vector<Eigen::half> to_half(std::span<const float> values) {
    std::vector<Eigen::half> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(),
                   [](float value) { return static_cast<Eigen::half>(value); });
    return halves;
}

}  // namespace

int values_per_texel(TexelFormat format) {
    return gl_format(format).values;
}

int bytes_per_texel(TexelFormat format) {
    return gl_format(format).bytes;
}

const char* sampler_type(TexelFormat format) {
    const bool integers = format == TexelFormat::r16i || format == TexelFormat::rgba16i ||
                          format == TexelFormat::rgba8i;
    return integers ? "isampler2D" : "sampler2D";
}

DataTexture::DataTexture(std::string name, TexelFormat format, int width_log2, int64_t num_texels)
    : name_(std::move(name)), format_(format), width_(1 << width_log2), num_texels_(num_texels) {
    PAIM_CHECK_LE(1, num_texels);
    const int64_t height = (num_texels + width_ - 1) / width_;
    const int max_size = max_texture_size();
    if (width_ > max_size || height > max_size) {
        throw_unsupported(
            "{}: {} texels need a texture of {} x {}, this driver's limit (GL_MAX_TEXTURE_SIZE) is "
            "{} x {}",
            name_, num_texels, width_, height, max_size, max_size);
    }
    height_ = static_cast<int>(height);
    const Format gl = gl_format(format);
    glActiveTexture(kUploadUnit);
    glBindTexture(GL_TEXTURE_2D, handle_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    check_errors("preparing a texture");
    glTexImage2D(GL_TEXTURE_2D, 0, gl.internal, width_, height_, 0, gl.external, gl.type, nullptr);
    check_errors(fmt::format("making room for {} ({} x {} texels, {:.0f} MB)", name_, width_,
                             height_, 1e-6 * bytes_per_texel(format) * width_ * height_));
}

template <typename Value>
void DataTexture::upload_as(const Fill<Value>& fill) const {
    PAIM_CHECK(fits<Value>(format_));
    const auto row_values =
        static_cast<size_t>(width_) * static_cast<size_t>(values_per_texel(format_));
    const int num_rows = std::min(height_, std::max(1, (1 << 16) / width_));
    std::vector<Value> values;
    for (int row = 0; row < height_; row += num_rows) {
        const int rows = std::min(num_rows, height_ - row);
        const int64_t first = int64_t{row} * width_;
        const int64_t count = std::min(int64_t{rows} * width_, num_texels_ - first);
        values.assign(static_cast<size_t>(rows) * row_values, Value{0});
        fill(first,
             std::span(values).first(static_cast<size_t>(count * values_per_texel(format_))));
        if constexpr (std::is_same_v<Value, float>) {
            if (format_ == TexelFormat::rgba16f) {
                upload_rows(row, width_, rows, to_half(values).data());
                continue;
            }
        }
        upload_rows(row, width_, rows, values.data());
    }
    check_errors(fmt::format("uploading {}", name_));
}

template void DataTexture::upload_as(const Fill<float>& fill) const;
template void DataTexture::upload_as(const Fill<int16_t>& fill) const;
template void DataTexture::upload_as(const Fill<int8_t>& fill) const;

void DataTexture::update(std::span<const float> values) const {
    const auto texel_values = static_cast<size_t>(values_per_texel(format_));
    const size_t row_values = static_cast<size_t>(width_) * texel_values;
    PAIM_CHECK(gl_format(format_).type == GL_FLOAT);
    PAIM_CHECK_LE(values.size(), static_cast<size_t>(num_texels_) * texel_values);
    const size_t num_rows = values.size() / row_values;
    const std::span<const float> rest = values.subspan(num_rows * row_values);
    if (num_rows > 0) {
        upload_rows(0, width_, static_cast<int>(num_rows), values.data());
    }
    if (rest.empty()) return;
    upload_rows(static_cast<int>(num_rows), static_cast<int>(rest.size() / texel_values), 1,
                rest.data());
}

// In a buffer, pointers are offsets.
void DataTexture::copy(const BufferHandle& buffer) const {
    PAIM_CHECK(gl_format(format_).type == GL_FLOAT);
    const auto num_rows = static_cast<int>(num_texels_ / width_);
    const auto rest = static_cast<int>(num_texels_ % width_);
    const size_t row_bytes =
        static_cast<size_t>(width_) * static_cast<size_t>(bytes_per_texel(format_));
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, buffer.id());
    if (num_rows > 0) upload_rows(0, width_, num_rows, nullptr);
    if (rest > 0) {
        upload_rows(num_rows, rest, 1,
                    reinterpret_cast<const void*>(static_cast<size_t>(num_rows) * row_bytes));
    }
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

void DataTexture::upload_rows(int first_row, int width, int num_rows, const void* values) const {
    const Format gl = gl_format(format_);
    glActiveTexture(kUploadUnit);
    glBindTexture(GL_TEXTURE_2D, handle_.id());
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, first_row, width, num_rows, gl.external, gl.type, values);
}

int fitting_width_log2(int64_t num_texels, int max_size) {
    PAIM_CHECK_LE(1, max_size);
    int max_log2 = 0;
    while ((2 << max_log2) <= max_size) ++max_log2;
    for (int width_log2 = std::min(10, max_log2); width_log2 <= max_log2; ++width_log2) {
        if ((num_texels + (int64_t{1} << width_log2) - 1) >> width_log2 <= max_size) {
            return width_log2;
        }
    }
    return -1;
}

}  // namespace paim::player::gl
