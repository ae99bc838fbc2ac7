// The frames that the outgoing side of a bake's glossy transfer is in.
#pragma once

#include <span>
#include <vector>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/tangent_frames.h"

namespace paim {

// Of the rows of a bake of glossy transfer alone (BakeReader::gloss()) or of its still mesh: frames of
// its faces (mesh/tangent_frames.h), whose z axes are the baked normals.
class BakedFrames {
  public:
    // first_pose  [3][R] positions
    BakedFrames(const Topology& topology, std::span<const float> first_pose)
        : frames_(topology, from_planes(first_pose)) {}

    // returns  [R] rotations from the frames to local axes
    std::vector<Eigen::Matrix3f> at(const BakedPose& pose) const {
        return frames_.at(from_planes(pose.positions), from_planes(pose.normals));
    }

  private:
    TangentFrames frames_;
};

}  // namespace paim
