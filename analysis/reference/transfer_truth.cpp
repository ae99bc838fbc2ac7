// The transfer of a bake's poses, baked again with many more rays.
#include "analysis/reference/transfer_truth.h"

#include <algorithm>
#include <utility>

#include "paim/base/check.h"
#include "paim/mesh/planes.h"

namespace paim {

namespace {

// Another one than people give, so that the truth shares no noise with the bake.
constexpr uint64_t kTruthSeed = 0x7a7e;

BakeOptions truth_options(const BakeIdentity& identity, uint32_t rays) {
    BakeOptions options;
    options.bands = identity.layout.in_bands;
    options.rays = rays;
    options.seed = identity.seed + kTruthSeed;
    options.bounces = identity.bounces;
    return options;
}

StillMesh still_mesh_of(const BakeReader& bake) {
    StillMesh mesh;
    if (!bake.still_mesh()) return mesh;
    const BakedStillMesh& baked = *bake.still_mesh();
    mesh.topology = baked.topology;
    mesh.albedo = baked.albedo;
    mesh.pose = {from_planes(baked.pose.positions), from_planes(baked.pose.normals)};
    return mesh;
}

}  // namespace

TransferTruth::TransferTruth(const BakeReader& bake)
    : bake_(bake),
      rays_(std::min(kMostTruthRays,
                     kTruthRaysByRays * std::min(bake.identity().rays, kMostTruthRays))),
      baker_(truth_options(bake.identity(), rays_), bake.albedo(), still_mesh_of(bake)) {
    // Poses need its light if it bounces.
    if (bake.still_mesh() && bake.identity().bounces > 0) baker_.bake_still_mesh();
}

DecodedPose TransferTruth::pose(uint32_t p) const {
    const BakeIdentity& identity = bake_.identity();
    BakedPose baked = bake_.read_pose(p);
    const RigidTransform root = root_at(identity.root_motion, p);
    move_to_scene(root, baked.positions, identity.num_following);
    transform_planes(root.rotation.toRotationMatrix(), Vec3d::Zero(), baked.normals,
                     identity.num_following);
    const Pose pose{from_planes(baked.positions), from_planes(baked.normals)};
    BakedPose truth = baker_.bake(bake_.topology(), pose, p);
    DecodedPose decoded;
    decoded.layout = baker_.layout();
    decoded.positions = std::move(truth.positions);
    decoded.transfer = std::move(truth.transfer);
    return decoded;
}

}  // namespace paim
