// Which vertices need more rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A vertex has met the target when both its own estimate of its noise and the mean of its neighbours'
// are at most the target. Its own alone would stop too many by luck, for it is one draw of a random
// number, and would overlook small occluders that none of its first rays hit but its neighbours' did.
// noise_energy  [V] squared error as estimated
// candidates    vertices to decide on, ascending
// returns       those that have not met the target, ascending
std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy, double target_energy,
                                         std::span<const uint32_t> candidates);

}  // namespace paim
