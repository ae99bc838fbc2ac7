// Where a compressed animation lies in space; what the player and the reference images frame, so
// that their default cameras agree.
#pragma once

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"
#include "paim/mesh/bounds.h"

namespace paim {

// Bounds of the positions at `time` (in poses, clamped as Decoder::decode does).
Bounds pose_bounds(const Model& model, double time, uint32_t num_geometry_components);

// Bounds of all poses, with all components. Long sequences of large meshes are sampled: every n-th
// pose and the last, with the smallest n that keeps the work within a few seconds. The same model
// gives the same bounds everywhere.
Bounds sequence_bounds(const Model& model);

}  // namespace paim
