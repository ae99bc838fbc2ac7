// The frames of glossy vertices, which the outgoing side of their transfer is in.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/codec/low_rank.h"
#include "paim/mesh/tangent_frames.h"

namespace paim {

// The faces among the glossy rows of a mesh, whose positions tell the frames of the rows.
// rows  [R] their vertices; empty: all
Topology faces_of_gloss(const Topology& whole, std::span<const uint32_t> rows);

// A turn of each frame: still, three planes of rotation vectors in radians, as integers.
// vectors  [R], of at most π
// returns  a matrix without points if all are zero, up to the step of the integers
LowRank frame_turns(std::span<const Vec3f> vectors);
// [R], or empty if there are none.
std::vector<Vec3f> turn_vectors(const LowRank& turns);

class GlossFrames {
  public:
    // faces      of faces_of_gloss()
    // reference  [3][R] positions of the first pose, in local axes
    // turns      [R] or empty: the frame of a vertex is that of the positions (tangent_frames.h) times
    //            its turn
    GlossFrames(const Topology& faces, std::span<const float> reference,
                std::span<const Vec3f> turns);

    // positions  [3][R] of a pose, in local axes
    // returns    [R] rotations from the frames to local axes
    std::vector<Eigen::Matrix3f> at(std::span<const float> positions) const;

  private:
    const TangentFrames frames_;
    std::vector<Eigen::Matrix3f> turns_;  // [R] or empty
};

}  // namespace paim
