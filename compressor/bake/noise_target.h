// Which vertices need more rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A vertex needs more rays while its squared error, as its neighbours tell it, is above the target. Its own
// estimate is one draw of a random number: going by it would stop those that are quiet by luck, and
// what they then say of their noise would be too little. The neighbours' draws are independent of it, and
// their rays find small occluders that its own first rays all miss. A vertex without neighbours goes by
// its own. As neighbours may have had other numbers of rays, what is averaged is their squared error times
// a power of the rays, which does not depend on the rays.
// noise_energy  [V] squared error as estimated
// num_rays      [V] that it is of; 0: nothing is known of this one
// power         with which squared errors fall (direction_sampler.h: error_power)
// candidates    vertices to decide on, ascending
// returns       those that have not met the target, ascending
std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy,
                                         std::span<const uint64_t> num_rays, double power,
                                         double target_energy,
                                         std::span<const uint32_t> candidates);

}  // namespace paim
