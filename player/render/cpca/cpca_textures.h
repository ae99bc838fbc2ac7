// Codec cpca in textures: the radiance of all bases in a small one, and of every vertex the cluster
// and the coefficients, so that triangles may cross from one cluster to another.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include <vector>

#include "paim/codec/cpca/cpca_player.h"
#include "player/gl/data_texture.h"
#include "player/render/transfer_textures.h"

namespace paim::player {

namespace shaders {
extern const std::string_view cpca_shade_glsl;  // cpca_shade.glsl
}

class CpcaTextures : public TransferTextures {
  public:
    CpcaTextures(const CodedMesh& mesh, const UploadPlan& plan);

    std::string_view shader() const override { return shaders::cpca_shade_glsl; }
    std::string defines() const override;
    uint64_t size_bytes() const override;
    int bind(const gl::Program& program, int unit, double time, const DecodeLimits& limits,
             const LightCoefficients& light) override;

  private:
    void update_basis_radiance(double time, DecodeLimits limits, const LightCoefficients& light);

    const VertexClusters& clusters_;
    UploadPlan plan_;
    CpcaPlayer player_;
    uint32_t num_int16_groups_;  // of four components, before those of 8-bit integers alone
    gl::DataTexture cluster_;
    gl::DataTexture int16_;  // coefficients of the first groups
    gl::DataTexture int8_;   // of the others
    gl::DataTexture basis_radiance_;
    std::vector<Vec3f> row_radiance_;
    std::vector<float> scratch_;  // as the texture holds them
};

TransferUploader cpca_uploader();

}  // namespace paim::player
