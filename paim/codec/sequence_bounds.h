// Where a compressed animation lies in space; what the player and the reference images frame, so
// that their default cameras agree.
#pragma once

#include <span>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"
#include "paim/mesh/bounds.h"

namespace paim {

// Bounds of all that is seen at `time` (in poses, clamped as Decoder::decode does): the positions,
// and the scenery as far as 500 diagonals of the positions' bounds around them. Whatever lies
// farther would take the depth buffer's precision from the animation.
Bounds pose_bounds(const Model& model, double time, uint32_t num_geometry_components);

// Bounds of all poses and of the scenery as far as one diagonal of the poses around them, so that a
// wide landscape does not make them small; with all components. Long sequences of large meshes are
// sampled: every n-th pose and the last, with the smallest n that keeps the work within a few
// seconds. The same model gives the same bounds everywhere.
Bounds sequence_bounds(const Model& model);

// What sequence_bounds() makes of the bounds of all poses and of the scenery's positions, [3][S].
Bounds framed_bounds(const Bounds& poses, std::span<const float> scenery_positions);

}  // namespace paim
