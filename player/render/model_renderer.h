// Draws poses of a compressed animation: the vertex shader rebuilds and shades them.
#pragma once

#include <vector>

#include "paim/codec/model.h"
#include "paim/light/light.h"
#include "player/gl/data_texture.h"
#include "player/gl/program.h"
#include "player/render/frame.h"
#include "player/render/upload_plan.h"

namespace paim::player {

class ModelRenderer {
  public:
    // Uploads what of the model is within the limits; frames cannot show more. Keeps a reference to
    // the model for its weights. Throws Error(unsupported) if it does not fit
    // (render/upload_plan.h).
    ModelRenderer(const Model& model, const DecodeLimits& limits);

    const UploadPlan& plan() const { return plan_; }

    // Draws the frame's pose under the light over what the current target holds.
    // light  already turned; bands beyond the light's are dark
    void draw(const Frame& frame, const LightCoefficients& light, float aspect);

  private:
    void upload_albedo() const;
    void upload_triangles();
    void update_weights(const LowRankMatrix& matrix, double time, const gl::DataTexture& texture);
    void update_light(const LightCoefficients& light, uint32_t bands);

    const Model& model_;
    UploadPlan plan_;
    gl::Program program_;
    gl::DataTexture geometry_mean_;
    gl::DataTexture geometry_components_;
    gl::DataTexture geometry_weights_;
    gl::DataTexture transfer_mean_;
    gl::DataTexture transfer_components_;
    gl::DataTexture transfer_weights_;
    gl::DataTexture light_;
    gl::DataTexture albedo_;
    gl::BufferHandle indices_;
    gl::VertexArrayHandle vertex_array_;
    std::vector<float> scratch_;
};

}  // namespace paim::player
