// A root motion as numbers of a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paim/mesh/root_motion.h"
#include "paim/mesh/topology.h"

namespace paim {

// Of a pose: the rotation vector, radians, then the translation, scene units.
constexpr uint32_t kRootNumbers = 6;

// [P][kRootNumbers]. Rotations that were made from multiples of kRotationUnit_rad give these again,
// which compress well.
std::vector<double> root_numbers(const RootMotion& motion);

// file  how messages begin: the name of the file, and of the section if it has some
// Errors (bad input): a rotation of more than half a turn, a translation beyond the range of floats,
// numbers that are not finite.
RootMotion root_motion_of(const std::vector<double>& numbers, const std::string& file);

// Triangles of vertices from num_following on, a floor, come after all others.
// Error (bad input): they do not, or a triangle has vertices of both.
void check_floor(const Topology& topology, uint32_t num_following, const std::string& file);

}  // namespace paim
