// Closed parts of a mesh that face inwards.
// Based on: van Oosterom and Strackee, The Solid Angle of a Plane Triangle, 1983
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// A part of the mesh: faces that are connected across edges of two faces, by their vertices or
// across a seam. It is closed if all of its edges are such ones, and all of its faces face the same
// side as their neighbours.
struct InwardPart {
    std::vector<uint32_t> triangles;  // their numbers, ascending
    uint32_t first_vertex = 0;        // the lowest one
};

// The closed parts whose signed volume is negative, in the order of their first triangles. A part
// that lies inside an odd number of other closed parts is not among them: it may be the wall of a
// cavity, which rightly faces its inside.
// positions  [V] finite, of a pose; parts without volume there are not judged
std::vector<InwardPart> find_inward_parts(const Topology& topology,
                                          std::span<const Vec3f> positions);

// Turns these triangles.
void turn_triangles(std::span<const uint32_t> triangles, Topology& topology);

}  // namespace paim
