// Transfer of every vertex, as mean + components · weights.
#pragma once

#include <vector>

#include "player/render/low_rank_textures.h"
#include "player/render/transfer_textures.h"

namespace paim::player {

class VertexTransfer : public TransferTextures {
  public:
    VertexTransfer(const Asset& model, const UploadPlan& plan);

    std::string defines() const override { return matrix_.defines(); }
    uint64_t size_bytes() const override { return matrix_.size_bytes() + light_.size_bytes(); }
    int bind(const gl::Program& program, int unit, const Frame& frame,
             const LightCoefficients& light) override;

  private:
    void update_light(const LightCoefficients& light, uint32_t bands);

    const Asset& model_;
    UploadPlan plan_;
    LowRankTextures matrix_;
    gl::DataTexture light_;
    std::vector<float> scratch_;
};

}  // namespace paim::player
