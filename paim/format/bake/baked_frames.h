// The frames that the outgoing side of a bake's glossy transfer is in.
#pragma once

#include <span>
#include <vector>

#include "paim/format/bake/baked_part.h"
#include "paim/mesh/planes.h"
#include "paim/mesh/tangent_frames.h"

namespace paim {

// Of a part of a bake of glossy transfer alone (BakeReader::gloss()): frames of its faces
// (mesh/tangent_frames.h), whose z axes are the baked normals.
class BakedFrames {
  public:
    // Keeps a reference to the bake.
    // part  0: the moving part; 1: the still part, which must exist (checked)
    BakedFrames(const BakeReader& gloss, size_t part)
        : part_(gloss, part), frames_(part_.topology(), positions(0)) {}

    // [R] of pose p, in local axes.
    std::vector<Vec3f> positions(uint32_t p) const {
        return read(&BakedPart::read_position_rows, p);
    }
    // returns  [R] rotations from the frames of pose p to local axes
    std::vector<Eigen::Matrix3f> at(uint32_t p) const {
        return frames_.at(positions(p), read(&BakedPart::read_normal_rows, p));
    }

  private:
    using ReadRows = void (BakedPart::*)(uint32_t, uint64_t, uint64_t, float*) const;
    std::vector<Vec3f> read(ReadRows rows, uint32_t p) const {
        std::vector<float> planes(size_t{3} * part_.num_vertices());
        (part_.*rows)(p, 0, planes.size(), planes.data());
        return from_planes(planes);
    }

    BakedPart part_;
    TangentFrames frames_;
};

}  // namespace paim
