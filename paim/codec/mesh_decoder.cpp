// Rebuilds poses of a coded mesh of any codec.
#include "paim/codec/mesh_decoder.h"

namespace paim {

void MeshDecoder::decode(double time, const DecodeLimits& limits, DecodedPose& out) {
    positions_.decode(mesh_.positions, time, limits.geometry_components, out.positions);
    player_->decode(time, limits, out.layout, out.transfer);
    out.root = root_at(mesh_.root_motion, time);
    out.num_following = mesh_.num_following;
}

}  // namespace paim
