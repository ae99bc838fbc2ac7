// A baked pose in the local coordinates of a body that travels and turns.
#pragma once

#include "paim/format/bake/bake_directory.h"

namespace paim {

// Moves positions, normals, transfer and noise of a pose to local coordinates and axes, in double.
// Norms of transfer and noise stay the same in every band. Glossy transfer is left to turn_gloss().
// offset         what is added to the positions to make them relative to the origin of `root`
// num_following  how many vertices, from the first, follow the root motion; the others stay as they are,
//                so that `offset` must be zero if there are any
void move_to_local(const RigidTransform& root, const Vec3d& offset, const TransferLayout& layout,
                   BakedPose& pose, uint32_t num_following = kAllVertices);

// Turns the glossy transfer of a pose and its noise to local axes, in double. Its outgoing side is in the
// frames of the vertices, which turn with the body.
// layout              of the glossy transfer
// num_following_rows  how many rows, from the first, are of vertices that follow
void turn_gloss(const RigidTransform& root, const TransferLayout& layout, BakedPose& pose,
                uint32_t num_following_rows);

}  // namespace paim
