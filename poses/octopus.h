// The example sequence: an octopus whose eight arms curl with travelling waves.
#pragma once

#include <memory>

#include "poses/sequence.h"

namespace paim::poses {

constexpr uint32_t kMinOctopusVertices = 1'000;
constexpr uint32_t kMaxOctopusVertices = 2'000'000;

// A smooth closed surface of exactly num_vertices vertices (kMin … kMaxOctopusVertices, else
// Error(usage)): closed, oriented outwards, one component, without handles, in every pose. It
// stands on Y up and looks along +Z, about 4 units high, 7 wide. Coloured.
std::unique_ptr<Sequence> make_octopus_sequence(uint32_t num_vertices);

PoseSet make_octopus(uint32_t num_vertices, uint32_t num_poses);

}  // namespace paim::poses
