// Rebuilds poses of a coded mesh of any codec.
#include "paim/codec/mesh_decoder.h"

namespace paim {

MeshDecoder::MeshDecoder(const CodedMesh& mesh)
    : mesh_(mesh), player_(mesh.transfer->make_player(mesh.layout)) {
    if (mesh.layout.kind != TransferKind::glossy) return;
    std::vector<float> first_pose;
    positions_.decode(mesh.positions, 0.0, mesh.positions.num_components, first_pose);
    frames_ =
        std::make_unique<GlossFrames>(mesh.topology, first_pose, turn_vectors(mesh.frame_turns));
}

void MeshDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) {
    positions_.decode(mesh_.positions, time, limits.geometry_components, out.positions);
    player_->decode(time, limits, out.layout, out.transfer);
    out.frames.clear();
    if (frames_ != nullptr) out.frames = frames_->at(out.positions);
    out.root = root_at(mesh_.root_motion, time);
    out.num_following = mesh_.num_following;
}

}  // namespace paim
