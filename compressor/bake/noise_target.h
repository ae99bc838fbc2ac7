// Which vertices need more rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A vertex needs more rays while its squared error, estimated together with its neighbours, is above the
// target. Alone its estimate would be one draw of a random number, which stops too many by luck and
// overlooks small occluders that none of its first rays hit but its neighbours' did. As neighbours may
// have had other numbers of rays, what is averaged is their error times rays^1.5, which does not depend on
// the rays (errors fall as rays^-0.75); the vertex itself counts as much as one neighbour.
// noise_energy  [V] squared error as estimated
// num_rays      [V] that it is of
// candidates    vertices to decide on, ascending
// returns       those that have not met the target, ascending
std::vector<uint32_t> above_noise_target(const Topology& topology,
                                         std::span<const double> noise_energy,
                                         std::span<const uint64_t> num_rays, double target_energy,
                                         std::span<const uint32_t> candidates);

}  // namespace paim
