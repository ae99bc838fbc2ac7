// Finds the vertices that need more rays, and how many.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compressor/bake/neighbours.h"

namespace paim {

struct RayDemand {
    uint32_t vertex;
    double rays;  // of one set, besides those it has traced

    bool operator==(const RayDemand&) const = default;
};

// A vertex needs more rays while its squared error is above the target, as estimated from its
// neighbours. Its own estimate is one draw of a random number: vertices with a low draw would stop
// too early, and would then report too little noise. The draws of the neighbours are independent of
// it, and their rays find small occluders that the first rays of the vertex all miss. A vertex
// without neighbours uses its own estimate.
// Neighbours may have different numbers of rays, so that errors are compared by *information*: the
// sum of N^power over the sets of N rays of a vertex. A squared error times the information does
// not depend on the rays, if squared errors of one set fall with this power and sets are averaged
// with weights N^power.
// noise_energy  [V] estimated squared error
// information   [V] of the rays of the estimate; 0: no estimate
// power         direction_sampler.h: error_power
// candidates    vertices to decide on, ascending
// returns       the candidates that need more rays, ascending
std::vector<RayDemand> above_noise_target(const Neighbours& neighbours,
                                          std::span<const double> noise_energy,
                                          std::span<const double> information, double power,
                                          double target_energy,
                                          std::span<const uint32_t> candidates);

}  // namespace paim
