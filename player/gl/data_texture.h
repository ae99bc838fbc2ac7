// A long array of texels in a 2D texture, read with texelFetch: texel t lies at
// (t mod width, t div width). The width is a power of two, so that shaders find it with a mask and
// a shift. No buffer textures: OpenGL ES 3.0 and WebGL 2 have none.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "player/gl/handle.h"

namespace paim::player::gl {

enum class TexelFormat {
    r32f,     // 1 float
    rgb32f,   // 3 floats
    rgba32f,  // 4 floats
    rgba16f,  // 4 floats, stored as half floats
    r16i,     // 1 integer of 16 bits
    rgba16i,  // 4 integers of 16 bits
    rgba8i,   // 4 integers of 8 bits
};

int values_per_texel(TexelFormat format);
int bytes_per_texel(TexelFormat format);

// The type of a GLSL sampler of such textures: sampler2D or isampler2D.
const char* sampler_type(TexelFormat format);

class DataTexture {
  public:
    // Writes texels [first, first + values.size() / values_per_texel) into values.
    template <typename Value>
    using Fill = std::function<void(int64_t first, std::span<Value> values)>;

    // Room for num_texels >= 1, rows of 2^width_log2 texels. Throws Error(unsupported) if the
    // texture would be higher than this driver's largest one, or does not fit into memory; `name`
    // says what it holds.
    DataTexture(std::string name, TexelFormat format, int width_log2, int64_t num_texels);

    // Fills all texels, a few rows at a time; the rest of the last row becomes zero. Values are of
    // the format's own type (checked): integers as wide as its own, or floats, for half floats as
    // well.
    void upload(const Fill<float>& fill) const { upload_as(fill); }
    void upload(const Fill<int16_t>& fill) const { upload_as(fill); }
    void upload(const Fill<int8_t>& fill) const { upload_as(fill); }

    // Overwrites the first texels of a format of 32-bit floats (checked); allocates nothing.
    // values.size() is a multiple of values_per_texel.
    void update(std::span<const float> values) const;

    // Overwrites all texels of a format of 32-bit floats (checked) with the first values of a buffer.
    void copy(const BufferHandle& buffer) const;

    const TextureHandle& handle() const { return handle_; }
    TexelFormat format() const { return format_; }
    int64_t num_texels() const { return num_texels_; }
    // Of the texels that were asked for.
    uint64_t size_bytes() const {
        return static_cast<uint64_t>(num_texels_) * static_cast<uint64_t>(bytes_per_texel(format_));
    }

  private:
    template <typename Value>
    void upload_as(const Fill<Value>& fill) const;
    // Texels [0, width) of so many rows, of the format's type.
    void upload_rows(int first_row, int width, int num_rows, const void* values) const;

    TextureHandle handle_;
    std::string name_;
    TexelFormat format_;
    int width_;
    int height_;
    int64_t num_texels_;
};

// The width_log2 with which num_texels fit into a texture of at most max_size by max_size, as
// narrow as possible but at least 1024 (or max_size) wide; -1 if they do not fit at all.
int fitting_width_log2(int64_t num_texels, int max_size);

}  // namespace paim::player::gl
