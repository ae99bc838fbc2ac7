// Finds the vertices that need more rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A vertex needs more rays while its squared error is above the target, as estimated from its
// neighbours. Its own estimate is one draw of a random number: vertices with a low draw would stop
// too early, and would then report too little noise. The draws of the neighbours are independent of
// it, and their rays find small occluders that the first rays of the vertex all miss. A vertex
// without neighbours uses its own estimate. Neighbours may have different numbers of rays, so the
// average is over squared errors times a power of the rays, which does not depend on the rays.
// noise_energy  [V] estimated squared error
// num_rays      [V] number of rays of the estimate; 0: no estimate
// power         of the rays, with which squared errors fall (direction_sampler.h: error_power)
// candidates    vertices to decide on, ascending
// returns       the candidates that need more rays, ascending
std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy,
                                         std::span<const uint64_t> num_rays, double power,
                                         double target_energy,
                                         std::span<const uint32_t> candidates);

}  // namespace paim
