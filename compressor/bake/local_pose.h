// A baked pose in the local coordinates of a body that travels and turns.
#pragma once

#include "paim/format/bake/bake_directory.h"

namespace paim {

// Moves positions, normals, transfer and noise of a pose to local coordinates and axes, in double.
// Norms of transfer and noise stay the same in every band.
// offset  what is added to the positions to make them relative to the origin of `root`
void move_to_local(const RigidTransform& root, const Vec3d& offset, const TransferLayout& layout,
                   BakedPose& pose);

}  // namespace paim
