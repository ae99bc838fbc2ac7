// Codec svd in textures: transfer of every vertex, as mean + components · weights.
#pragma once

#include <vector>

#include "player/render/low_rank_textures.h"
#include "player/render/transfer_textures.h"

namespace paim::player {

namespace shaders {
extern const std::string_view svd_shade_glsl;  // svd_shade.glsl
}

class SvdTextures : public TransferTextures {
  public:
    SvdTextures(const CodedMesh& mesh, const UploadPlan& plan);

    std::string_view shader() const override { return shaders::svd_shade_glsl; }
    std::string defines() const override { return matrix_.defines(); }
    uint64_t size_bytes() const override { return matrix_.size_bytes() + light_.size_bytes(); }
    int bind(const gl::Program& program, int unit, double time, const DecodeLimits& limits,
             const LightCoefficients& light) override;

  private:
    void update_light(const LightCoefficients& light, uint32_t bands);

    const CodedMesh& mesh_;
    UploadPlan plan_;
    LowRankTextures matrix_;
    gl::DataTexture light_;
    std::vector<float> scratch_;
};

TransferUploader svd_uploader();

// Texels of all components, as if they were in one texture.
int64_t svd_transfer_texels(const CodedMesh& mesh, uint32_t num_components, uint32_t bands);

}  // namespace paim::player
