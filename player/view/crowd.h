// Copies of one animation on a grid.
#pragma once

#include <cstdint>
#include <vector>

#include "paim/mesh/bounds.h"
#include "player/render/frame.h"

namespace paim::player {

// `count` copies on a square grid on the ground, the first in the middle of it, far enough apart that no
// two touch. Each starts at another time: fractions of the animation that are a golden section apart,
// so that no two neighbours move together.
// reach  bounds of all poses
std::vector<Instance> make_crowd(uint32_t count, const Bounds& reach, uint32_t num_poses);

// Bounds of all copies.
Bounds crowd_bounds(const std::vector<Instance>& crowd, const Bounds& reach);

}  // namespace paim::player
