// Poses of another source whose isolated vertices do not move.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paim/mesh/pose_source.h"

namespace paim {

// Vertices that no face has cannot be seen. Exporters put them anywhere, still or moving. Here all
// of them lie at one place in every pose: the point of the bounding box of the first pose's faces
// that is nearest to the origin of the coordinates. So they add nothing to bounds, have no
// components, and no coordinate of a mean is larger because of them. (Where poses have offsets or
// local coordinates, the place is that of the first pose there.) They have no normal, and so no
// transfer. Without such vertices this is the source itself.
class IsolatedAtRest : public PoseSource {
  public:
    // Keeps a reference to the source, and reads its first pose if there are isolated vertices.
    explicit IsolatedAtRest(const PoseSource& source);

    const Topology& topology() const override { return source_.topology(); }
    const Albedo& albedo() const override { return source_.albedo(); }
    const Texture& texture() const override { return source_.texture(); }
    uint32_t num_poses() const override { return source_.num_poses(); }
    Vec3d origin() const override { return source_.origin(); }
    Vec3d pose_offset(uint32_t p) const override { return source_.pose_offset(p); }
    uint32_t num_moving_vertices() const override { return source_.num_moving_vertices(); }
    std::string pose_name(uint32_t p) const override { return source_.pose_name(p); }
    // Of the source's pose and of the place, so that poses with another place are other poses.
    uint64_t pose_checksum(uint32_t p) const override;
    Pose load_pose(uint32_t p) const override;

    // Their numbers, and their place relative to the offset of the first pose.
    const std::vector<uint32_t>& isolated() const { return isolated_; }
    const Vec3f& place() const { return place_; }

  private:
    const PoseSource& source_;
    std::vector<uint32_t> isolated_;
    Vec3f place_ = Vec3f::Zero();
};

}  // namespace paim
