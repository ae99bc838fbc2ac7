// A matrix in textures, for the vertex shader to rebuild (shaders/vertex_data.glsl): its mean, its
// components and their weights at a time.
#pragma once

#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "player/gl/data_texture.h"
#include "player/gl/program.h"
#include "player/render/group_gather.h"

namespace paim::player {

class LowRankTextures {
  public:
    // Keeps a reference to the matrix for its weights.
    // name    what the shader's names begin with: "geometry" or "transfer"
    // planes  of the matrix that are uploaded, num_components of each
    LowRankTextures(std::string name, const LowRank& matrix, const PlaneGroups& planes,
                    uint32_t num_components, int width_log2);

    // Types of the samplers.
    std::string defines() const;
    uint64_t size_bytes() const;

    // Uploads the weights of `time`, hands textures and counts to the program, which is in use, and
    // returns the first texture unit that is free after those from `unit`.
    int bind(const gl::Program& program, int unit, double time, uint32_t num_components);

  private:
    std::string name_;
    const LowRank& matrix_;
    uint32_t num_components_;
    uint32_t num_int16_;
    gl::DataTexture mean_;
    gl::DataTexture int16_;  // components 0 … num_int16 − 1 (value_textures.h)
    gl::DataTexture int8_;   // the others
    gl::DataTexture weights_;
    std::vector<float> scratch_;
};

}  // namespace paim::player
