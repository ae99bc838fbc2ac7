// One coded mesh in textures, and the shaders that decode and light it.
#pragma once

#include <memory>
#include <span>

#include "paim/codec/asset.h"
#include "paim/light/light.h"
#include "player/gl/data_texture.h"
#include "player/gl/feedback.h"
#include "player/gl/program.h"
#include "player/render/low_rank_textures.h"
#include "player/render/transfer_textures.h"
#include "player/render/upload_plan.h"

namespace paim::player {

class ShaderMesh {
  public:
    // Uploads the mesh within the limits; no more can be decoded. Keeps a reference to the mesh for
    // everything that changes with time and light. Throws Error(unsupported) if it does not fit
    // (render/upload_plan.h).
    ShaderMesh(const CodedMesh& mesh, const DecodeLimits& limits);

    const UploadPlan& plan() const { return plan_; }

    // Of all textures.
    uint64_t texture_bytes() const;

    // Writes local positions at `time`, scene units.
    // positions  [V][3] 32-bit floats
    void decode(double time, const DecodeLimits& limits, const gl::BufferHandle& positions);

    // Writes radiance under a light of the scene, linear RGB; bands beyond the light's are dark.
    // colors  [V][3] 32-bit floats: radiance and, if the mesh has a texture, radiance of the same
    //         surface in white
    void light(double time, const DecodeLimits& limits, const LightCoefficients& light,
               std::span<const gl::BufferHandle* const> colors);

  private:
    void upload_albedo() const;
    // Of vertices [first, first + count), under a light in their axes.
    void light_vertices(uint32_t first, uint32_t count, double time, const DecodeLimits& limits,
                        const LightCoefficients& light,
                        std::span<const gl::BufferHandle* const> colors);

    const CodedMesh& mesh_;
    UploadPlan plan_;
    LowRankTextures geometry_;
    std::unique_ptr<TransferTextures> transfer_;
    gl::Program position_program_;
    gl::Program radiance_program_;
    gl::DataTexture albedo_;
    gl::VertexCapture capture_;
};

}  // namespace paim::player
