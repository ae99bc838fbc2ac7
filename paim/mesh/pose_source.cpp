// A pose sequence with one topology.
#include "paim/mesh/pose_source.h"

namespace paim {

Pose load_from_origin(const PoseSource& source, uint32_t p) {
    Pose pose = source.load_pose(p);
    const Vec3d offset = source.pose_offset(p);
    if (offset.isZero(0.0)) return pose;
    for (Vec3f& position : pose.positions) {
        position = (position.cast<double>() + offset).cast<float>();
    }
    return pose;
}

}  // namespace paim
