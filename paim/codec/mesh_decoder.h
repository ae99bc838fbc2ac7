// Rebuilds poses of a coded mesh of any codec.
#pragma once

#include <memory>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"
#include "paim/codec/gloss_frames.h"
#include "paim/codec/rebuild_planes.h"
#include "paim/codec/transfer_player.h"

namespace paim {

// One rebuilt pose.
struct DecodedPose {
    TransferLayout layout;         // with the bands within the limits
    std::vector<float> positions;  // [3][V] local coordinates, scene units
    std::vector<float> transfer;   // [layout.num_planes()][V] in local axes
    // [V] Of glossy transfer: rotations from the frames of its outgoing side to local axes. Else empty.
    std::vector<Eigen::Matrix3f> frames;
    RigidTransform root;                    // from local coordinates to the scene
    uint32_t num_following = kAllVertices;  // of the vertices, from the first, that stand there
};

// Keeps scratch memory; each thread needs its own decoder.
class MeshDecoder {
  public:
    // Keeps a reference to the mesh.
    explicit MeshDecoder(const CodedMesh& mesh);
    explicit MeshDecoder(CodedMesh&&) = delete;

    uint32_t num_vertices() const { return mesh_.topology.num_vertices; }
    uint32_t num_poses() const { return mesh_.num_poses(); }

    // Rebuilds the pose at `time` in poses, clamped to 0 … P−1. At fractions weights are
    // interpolated linearly. Reuses the memory of `out`.
    void decode(double time, const DecodeLimits& limits, DecodedPose& out);

  private:
    const CodedMesh& mesh_;
    PositionDecoder positions_;
    std::unique_ptr<TransferPlayer> player_;
    std::unique_ptr<GlossFrames> frames_;  // only of glossy transfer
};

}  // namespace paim
