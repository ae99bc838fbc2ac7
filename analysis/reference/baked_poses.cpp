// The poses of a bake, to be baked again.
#include "analysis/reference/baked_poses.h"

#include <algorithm>

#include "paim/mesh/planes.h"

namespace paim {

uint32_t BakedPoses::num_moving_vertices() const {
    return std::min(bake_.identity().num_following, bake_.identity().num_vertices);
}

Pose BakedPoses::load_pose(uint32_t p) const {
    const BakeIdentity& identity = bake_.identity();
    BakedPose baked = bake_.read_pose(p);
    const RigidTransform root = root_at(identity.root_motion, p);
    move_to_scene(root, baked.positions, identity.num_following);
    transform_planes(root.rotation.toRotationMatrix(), Vec3d::Zero(), baked.normals,
                     identity.num_following);
    return {from_planes(baked.positions), from_planes(baked.normals)};
}

Surroundings surroundings_of(const BakeReader& bake) {
    Surroundings surroundings;
    surroundings.floor = bake.identity().floor;
    if (!bake.still_mesh()) return surroundings;
    const BakedStillMesh& baked = *bake.still_mesh();
    StillMesh& mesh = surroundings.still_mesh;
    mesh.topology = baked.topology;
    mesh.albedo = baked.albedo;
    mesh.pose = {from_planes(baked.pose.positions), from_planes(baked.pose.normals)};
    mesh.sources = bake.identity().still_meshes;
    return surroundings;
}

BakeOptions options_of(const BakeIdentity& identity) {
    BakeOptions options;
    options.bands = identity.layout.in_bands;
    options.rays = identity.rays;
    options.seed = identity.seed;
    options.bounces = identity.bounces;
    return options;
}

void bake_again(const BakeReader& bake, const BakeOptions& options,
                const std::filesystem::path& directory,
                const std::function<void(uint32_t)>& on_pose) {
    bake_sequence(BakedPoses(bake), options, bake.identity().normals, directory, 0,
                  bake.num_poses() - 1, on_pose, surroundings_of(bake),
                  bake.identity().root_motion);
}

}  // namespace paim
