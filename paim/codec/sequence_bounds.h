// Where a compressed animation lies in space; what the player and the reference images frame, so
// that their default cameras agree.
#pragma once

#include <span>

#include "paim/codec/asset.h"
#include "paim/mesh/bounds.h"

namespace paim {

// Bounds of all that is seen at `time` (in poses, clamped to 0 … P−1): the part that moves, and the
// parts that stand still as far as 500 diagonals of its bounds around it. Anything farther away would
// take the depth buffer's precision from the animation.
Bounds pose_bounds(const Asset& asset, double time, uint32_t num_geometry_components);

// Bounds of all poses and of still parts as far as one diagonal of the poses around them, so that a
// wide landscape does not make the character small; with all components. Long sequences of large meshes
// are sampled: every n-th pose and the last, with the smallest n that keeps the work within a few
// seconds. The same asset gives the same bounds everywhere.
Bounds sequence_bounds(const Asset& asset);

// What sequence_bounds() makes of the bounds of all poses and of everything that stands still.
Bounds framed_bounds(const Bounds& poses, const Bounds& still);

}  // namespace paim
