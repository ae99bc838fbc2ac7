// A pose sequence with one topology.
#include "paim/mesh/pose_source.h"

namespace paim {

namespace {

void add(const Vec3d& offset, std::vector<Vec3f>& positions) {
    if (offset.isZero(0.0)) return;
    for (Vec3f& position : positions) {
        position = (position.cast<double>() + offset).cast<float>();
    }
}

}  // namespace

const Materials& PoseSource::materials() const {
    static const Materials matte;
    return matte;
}

const Texture& PoseSource::texture() const {
    static const Texture none;
    return none;
}

Pose load_from_origin(const PoseSource& source, uint32_t p) {
    Pose pose = source.load_pose(p);
    add(source.pose_offset(p), pose.positions);
    return pose;
}

std::vector<Vec3f> load_positions_from_origin(const PoseSource& source, uint32_t p) {
    std::vector<Vec3f> positions = source.load_positions(p);
    add(source.pose_offset(p), positions);
    return positions;
}

}  // namespace paim
