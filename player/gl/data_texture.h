// A long array of texels in a 2D texture, read with texelFetch: texel t lies at
// (t mod width, t div width). The width is a power of two, so that shaders find it with a mask and
// a shift. No buffer textures: OpenGL ES 3.0 and WebGL 2 have none.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "player/gl/handle.h"

namespace paim::player::gl {

enum class TexelFormat {
    r32f,     // 1 float
    rgba32f,  // 4 floats
    rgba16f,  // 4 floats, stored as half floats
};

int floats_per_texel(TexelFormat format);
int bytes_per_texel(TexelFormat format);

class DataTexture {
  public:
    // Writes texels [first, first + values.size() / floats_per_texel) into values.
    using Fill = std::function<void(int64_t first, std::span<float> values)>;

    // Room for num_texels >= 1, rows of 2^width_log2 texels. Throws Error(unsupported) if the
    // texture would be higher than this driver's largest one, or does not fit into memory; `name`
    // says what it holds.
    DataTexture(const char* name, TexelFormat format, int width_log2, int64_t num_texels);

    // Fills all texels, a few rows at a time; the rest of the last row becomes zero.
    void upload(const Fill& fill) const;

    // Overwrites the first texels. values.size() is a multiple of floats_per_texel.
    void update(std::span<const float> values) const;

    const TextureHandle& handle() const { return handle_; }
    int64_t num_texels() const { return num_texels_; }

  private:
    void upload_rows(int first_row, int num_rows, std::span<const float> values) const;

    TextureHandle handle_;
    const char* name_;
    TexelFormat format_;
    int width_;
    int height_;
    int64_t num_texels_;
};

// The width_log2 with which num_texels fit into a texture of at most max_size by max_size, as
// narrow as possible but at least 1024 (or max_size) wide; -1 if they do not fit at all.
int fitting_width_log2(int64_t num_texels, int max_size);

}  // namespace paim::player::gl
