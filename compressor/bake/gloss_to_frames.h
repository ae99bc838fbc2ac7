// The glossy transfer of a baked pose in the frames of its vertices.
#pragma once

#include <span>
#include <vector>

#include "paim/format/bake/bake_directory.h"
#include "paim/mesh/materials.h"
#include "paim/mesh/tangent_frames.h"

namespace paim {

// Frames of the glossy rows of a mesh in all of its poses, from its faces among them.
class RowFrames {
  public:
    // first_pose  [3][V] positions, as they are stored (in local axes); empty if nothing is glossy
    RowFrames(const Topology& topology, const Materials& materials,
              std::span<const float> first_pose);

    // The z axes are the normals of the pose.
    // pose     its positions and normals, as they are stored
    // returns  [R] rotations from the frames to the axes of these
    std::vector<Eigen::Matrix3f> at(const BakedPose& pose) const;

  private:
    const std::vector<uint32_t> rows_;
    const TangentFrames frames_;
};

// Turns outgoing coefficients of the transfer and its noise from the axes of the pose to frames, and
// keeps the even ones, in double. The others are zero but for rounding, because the mirror image
// continues reflections below the surface (docs/algorithms/gloss.md).
// layout  of kind glossy, of what is kept
// pose    in: gloss and noise of kind glossy_in_pose; out: of the layout, with its statistics
// frames  [R]
void gloss_to_frames(const TransferLayout& layout, std::span<const Eigen::Matrix3f> frames,
                     BakedPose& pose);

}  // namespace paim
