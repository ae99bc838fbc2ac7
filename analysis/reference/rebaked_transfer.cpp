// The transfer of a bake's poses, baked again with other options.
#include "analysis/reference/rebaked_transfer.h"

#include <utility>

#include "analysis/reference/baked_poses.h"

namespace paim {

RebakedTransfer::RebakedTransfer(const BakeReader& bake, const BakeOptions& options)
    : bake_(bake),
      rays_(options.rays),
      baker_(options, bake.albedo(), surroundings_of(bake).still_mesh) {
    // Poses need its light if it bounces.
    if (bake.still_mesh()) still_ = decoded(baker_.bake_still_mesh());
}

DecodedPose RebakedTransfer::decoded(BakedPose baked) const {
    DecodedPose pose;
    pose.layout = baker_.layout();
    pose.positions = std::move(baked.positions);
    pose.transfer = std::move(baked.transfer);
    return pose;
}

DecodedPose RebakedTransfer::pose(uint32_t p, std::vector<float>* noise) const {
    BakedPose baked = baker_.bake(bake_.topology(), BakedPoses(bake_).load_pose(p), p);
    if (noise != nullptr) *noise = std::move(baked.noise);
    return decoded(std::move(baked));
}

}  // namespace paim
