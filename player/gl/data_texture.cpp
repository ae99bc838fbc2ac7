// Uploading arrays as 2D textures.
#include "player/gl/data_texture.h"

#include <Eigen/Core>

#include <algorithm>
#include <vector>

#include "paim/base/check.h"
#include "paim/base/error.h"
#include "player/gl/check.h"

namespace paim::player::gl {

namespace {

struct Format {
    GLint internal;
    GLenum external;
    GLenum type;
};

Format gl_format(TexelFormat format) {
    switch (format) {
        case TexelFormat::r32f:
            return {GL_R32F, GL_RED, GL_FLOAT};
        case TexelFormat::rgba16f:
            return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT};
        case TexelFormat::rgba32f:
            break;
    }
    return {GL_RGBA32F, GL_RGBA, GL_FLOAT};
}

}  // namespace

int floats_per_texel(TexelFormat format) {
    return format == TexelFormat::r32f ? 1 : 4;
}

int bytes_per_texel(TexelFormat format) {
    return format == TexelFormat::r32f ? 4 : format == TexelFormat::rgba16f ? 8 : 16;
}

DataTexture::DataTexture(const char* name, TexelFormat format, int width_log2, int64_t num_texels)
    : name_(name), format_(format), width_(1 << width_log2), num_texels_(num_texels) {
    PAIM_CHECK_LE(1, num_texels);
    const int64_t height = (num_texels + width_ - 1) / width_;
    const int max_size = max_texture_size();
    if (width_ > max_size || height > max_size) {
        throw_unsupported(
            "{}: {} texels need a texture of {} x {}, this driver's limit (GL_MAX_TEXTURE_SIZE) is "
            "{} x {}",
            name, num_texels, width_, height, max_size, max_size);
    }
    height_ = static_cast<int>(height);
    const Format gl = gl_format(format);
    glBindTexture(GL_TEXTURE_2D, handle_.id());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    check_errors("preparing a texture");
    glTexImage2D(GL_TEXTURE_2D, 0, gl.internal, width_, height_, 0, gl.external, gl.type, nullptr);
    check_errors(fmt::format("making room for {} ({} x {} texels, {:.0f} MB)", name, width_,
                             height_, 1e-6 * bytes_per_texel(format) * width_ * height_));
}

void DataTexture::upload(const Fill& fill) const {
    const auto row_floats =
        static_cast<size_t>(width_) * static_cast<size_t>(floats_per_texel(format_));
    const int num_rows = std::min(height_, std::max(1, (1 << 16) / width_));
    std::vector<float> values;
    for (int row = 0; row < height_; row += num_rows) {
        const int rows = std::min(num_rows, height_ - row);
        const int64_t first = int64_t{row} * width_;
        const int64_t count = std::min(int64_t{rows} * width_, num_texels_ - first);
        values.assign(static_cast<size_t>(rows) * row_floats, 0.0f);
        fill(first,
             std::span(values).first(static_cast<size_t>(count * floats_per_texel(format_))));
        upload_rows(row, rows, values);
    }
    check_errors(fmt::format("uploading {}", name_));
}

void DataTexture::update(std::span<const float> values) const {
    const auto row_floats =
        static_cast<size_t>(width_) * static_cast<size_t>(floats_per_texel(format_));
    const size_t num_rows = (values.size() + row_floats - 1) / row_floats;
    PAIM_CHECK_LE(static_cast<int64_t>(values.size()), num_texels_ * floats_per_texel(format_));
    if (num_rows == 0) return;
    std::vector<float> padded(num_rows * row_floats, 0.0f);
    std::copy(values.begin(), values.end(), padded.begin());
    upload_rows(0, static_cast<int>(num_rows), padded);
}

void DataTexture::upload_rows(int first_row, int num_rows, std::span<const float> values) const {
    const Format gl = gl_format(format_);
    glBindTexture(GL_TEXTURE_2D, handle_.id());
    if (format_ != TexelFormat::rgba16f) {
        glTexSubImage2D(GL_TEXTURE_2D, 0, 0, first_row, width_, num_rows, gl.external, gl.type,
                        values.data());
        return;
    }
    std::vector<Eigen::half> halves(values.size());
    std::transform(values.begin(), values.end(), halves.begin(),
                   [](float value) { return Eigen::half(value); });
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, first_row, width_, num_rows, gl.external, gl.type,
                    halves.data());
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
