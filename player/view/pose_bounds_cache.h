// Bounds of any moment of an animation, decoding each pose only once.
#pragma once

#include <optional>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/mesh/bounds.h"

namespace paim::player {

class PoseBoundsCache {
  public:
    // Keeps a reference to the asset.
    explicit PoseBoundsCache(const Asset& asset) : asset_(asset) {}

    // Bounds that hold the mesh at `time` (in poses, clamped): those of the poses before and after,
    // between which every vertex moves on a straight line.
    Bounds at(double time, uint32_t num_geometry_components);

  private:
    const Bounds& of_pose(size_t p);

    const Asset& asset_;
    uint32_t num_components_ = 0;
    std::vector<std::optional<Bounds>>
        bounds_;  // [P] with num_components_; empty: not computed yet
};

}  // namespace paim::player
