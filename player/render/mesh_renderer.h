// Draws poses of one coded mesh: the vertex shader rebuilds and shades them.
#pragma once

#include <memory>

#include "paim/codec/asset.h"
#include "paim/light/light.h"
#include "player/gl/data_texture.h"
#include "player/gl/program.h"
#include "player/render/frame.h"
#include "player/render/low_rank_textures.h"
#include "player/render/transfer_textures.h"
#include "player/render/upload_plan.h"

namespace paim::player {

class MeshRenderer {
  public:
    // Uploads the mesh within the limits; frames cannot show more. Keeps a reference to the mesh
    // for everything that changes with time and light. Throws Error(unsupported) if it does not fit
    // (render/upload_plan.h).
    MeshRenderer(const CodedMesh& mesh, const DecodeLimits& limits);

    const UploadPlan& plan() const { return plan_; }

    // Of all textures.
    uint64_t texture_bytes() const;

    // Draws the frame's pose under the light over what the current target holds.
    // light   already turned; bands beyond the light's are dark
    // aspect  of the whole picture
    void draw(const Frame& frame, const LightCoefficients& light, float aspect);

  private:
    void upload_albedo() const;
    void upload_triangles();
    // Draws triangles [first, last), which stand in the scene like `root`.
    void draw_triangles(size_t first, size_t last, const RigidTransform& root, const Frame& frame,
                        const LightCoefficients& light, float aspect);

    const CodedMesh& mesh_;
    size_t num_following_triangles_;  // those of a floor come after them
    UploadPlan plan_;
    LowRankTextures geometry_;
    std::unique_ptr<TransferTextures> transfer_;
    gl::Program program_;
    gl::DataTexture albedo_;
    gl::BufferHandle indices_;
    gl::VertexArrayHandle vertex_array_;
};

}  // namespace paim::player
