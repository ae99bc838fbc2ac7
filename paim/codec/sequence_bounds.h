// Bounds of a coded animation in space, of vertices that a face has (mesh/face_vertices.h). The
// player and the reference images frame them, so that their default cameras agree. Outliers
// (mesh/outliers.h) are left out: their vertices are where they are without exceptions.
#pragma once

#include <cstdint>

#include "paim/codec/asset.h"
#include "paim/mesh/bounds.h"

namespace paim {

// Bounds of the moving part at `time` (in poses, clamped to 0 … P−1), decoded with the first
// components, and of still parts as far as 500 of its diagonals around it. Anything farther away
// would take the depth buffer's precision from the animation.
Bounds pose_bounds(const Asset& asset, double time, uint32_t num_geometry_components);

// Work that sequence_bounds() may do: about two seconds on one core.
inline constexpr uint64_t kMaxBoundsMultiplyAdds = uint64_t{1} << 33;

// Bounds of all poses, decoded with all components, and of still parts as far as one diagonal of
// the poses around them, so that a wide landscape does not make the character small. The same asset
// gives the same bounds on every machine.
// max_multiply_adds  If decoding all poses takes more, the bounds are those of every n-th pose and the
//                    last, with the smallest n that keeps the poses before the last within it; of at
//                    most 3 poses if even two take more.
Bounds sequence_bounds(const Asset& asset, uint64_t max_multiply_adds = kMaxBoundsMultiplyAdds);

// The bounds that sequence_bounds() makes of the bounds of all poses and those of all still parts.
Bounds framed_bounds(const Bounds& poses, const Bounds& still);

}  // namespace paim
