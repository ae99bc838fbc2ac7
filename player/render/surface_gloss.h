// The gloss of a surface as shaders read it: outgoing coefficients of rows, and the row of each vertex.
#pragma once

#include <cstdint>
#include <span>

#include "paim/codec/asset.h"
#include "player/gl/data_texture.h"
#include "player/gl/program.h"

namespace paim::player {

class SurfaceGloss {
  public:
    // mesh  with gloss (checked)
    // Errors (unsupported): this driver's textures hold fewer rows, or not enough memory.
    explicit SurfaceGloss(const CodedMesh& mesh);

    uint32_t out_bands() const { return out_bands_; }

    // exits  [out_bands²][R] (checked), linear RGB
    void upload(std::span<const Vec3f> exits) const;

    // Sets the uniforms of gloss_vertex_source() (render/gloss_shader.h) of a program in use.
    // unit  the first of two texture units that it may use
    // eye   in local coordinates
    void set(const gl::Program& program, int unit, const Vec3f& eye) const;

    uint64_t texture_bytes() const { return exits_.size_bytes() + rows_.size_bytes(); }

  private:
    uint32_t num_rows_;
    uint32_t out_bands_;
    int width_log2_;
    gl::DataTexture exits_, rows_;
};

}  // namespace paim::player
