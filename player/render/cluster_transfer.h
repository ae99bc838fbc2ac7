// Clustered transfer: the light products of all bases in a small texture, and of every vertex the
// cluster and the coefficients, so that no triangle cares where clusters meet.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003
#pragma once

#include <vector>

#include "paim/shade/cluster_light.h"
#include "player/gl/data_texture.h"
#include "player/render/transfer_textures.h"

namespace paim::player {

class ClusterTransfer : public TransferTextures {
  public:
    ClusterTransfer(const Model& model, const UploadPlan& plan);

    std::string defines() const override;
    uint64_t size_bytes() const override;
    int bind(const gl::Program& program, int unit, const Frame& frame,
             const LightCoefficients& light) override;

  private:
    void update_products(const Frame& frame, const LightCoefficients& light);

    const VertexClusters& clusters_;
    UploadPlan plan_;
    ClusterLight light_;
    uint32_t num_int16_groups_;  // of four components, before those of 8-bit integers alone
    gl::DataTexture cluster_;
    gl::DataTexture int16_;  // coefficients of the first groups
    gl::DataTexture int8_;   // of the others
    gl::DataTexture products_;
    std::vector<Vec3f> row_products_;
    std::vector<float> scratch_;  // products as the texture holds them
};

}  // namespace paim::player
