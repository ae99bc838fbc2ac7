// Decodes and lights vertices in shaders, from textures that hold the coded meshes.
#pragma once

#include <memory>
#include <vector>

#include "paim/codec/gloss_player.h"
#include "paim/codec/rebuild_planes.h"
#include "player/render/shader_mesh.h"
#include "player/render/vertex_source.h"

namespace paim::player {

class ShaderVertices : public VertexSource {
  public:
    // Uploads all parts. Errors: those of ShaderMesh.
    ShaderVertices(std::shared_ptr<const Asset> asset, const DecodeLimits& limits);

    DecodeLimits most() const override;
    bool is_on_cpu() const override { return false; }
    uint64_t texture_bytes() const override;

  private:
    void write(double time, const DecodeLimits& limits, const LightCoefficients* light,
               std::span<const Changes> changes, std::span<SurfaceMesh> parts) override;

    std::shared_ptr<const Asset> asset_;
    std::vector<std::unique_ptr<ShaderMesh>> meshes_;
    std::vector<std::unique_ptr<GlossPlayer>> glosses_;  // [parts]; null where there is no gloss
    std::vector<bool> is_placed_;  // [parts] whether the gloss knows the positions
    PositionDecoder decoder_;
    std::vector<float> positions_;  // scratch
    uint32_t most_bands_ = 0;       // of light
};

}  // namespace paim::player
