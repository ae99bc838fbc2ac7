// The transfer of a bake's poses, baked again with many more rays.
#include "analysis/reference/transfer_truth.h"

#include <algorithm>
#include <utility>

#include "analysis/reference/baked_poses.h"

namespace paim {

namespace {

// Another one than people give, so that the truth shares no noise with the bake.
constexpr uint64_t kTruthSeed = 0x7a7e;

BakeOptions truth_options(const BakeIdentity& identity, uint32_t rays) {
    BakeOptions options = options_of(identity);
    options.rays = rays;
    options.seed += kTruthSeed;
    return options;
}

}  // namespace

TransferTruth::TransferTruth(const BakeReader& bake)
    : bake_(bake),
      rays_(std::min(kMostTruthRays,
                     kTruthRaysByRays * std::min(bake.identity().rays, kMostTruthRays))),
      baker_(truth_options(bake.identity(), rays_), bake.albedo(),
             surroundings_of(bake).still_mesh) {
    // Poses need its light if it bounces.
    if (bake.still_mesh()) still_ = decoded(baker_.bake_still_mesh());
}

DecodedPose TransferTruth::decoded(BakedPose baked) const {
    DecodedPose pose;
    pose.layout = baker_.layout();
    pose.positions = std::move(baked.positions);
    pose.transfer = std::move(baked.transfer);
    return pose;
}

DecodedPose TransferTruth::pose(uint32_t p) const {
    return decoded(baker_.bake(bake_.topology(), BakedPoses(bake_).load_pose(p), p));
}

}  // namespace paim
