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

// The closed parts that face inwards, in the order of their first triangles. A part faces inwards in
// a pose if its signed volume is negative there, and it lies inside an even number of other closed
// parts: inside an odd number it may be the wall of a cavity, which rightly faces its inside. More
// poses must say so than say the opposite. A pose says nothing about a part that would face the
// other side without the vertices that lie far from its others (mesh/far_vertices.h), so that
// outliers decide in none.
// poses   [poses][V] finite: the first one, and perhaps others. Parts without volume in the first
//         one are not judged
// places  [V] the places that vertices share in the first pose (sequence_places.h). Empty: those of
//         its positions
std::vector<InwardPart> find_inward_parts(const Topology& topology,
                                          std::span<const std::vector<Vec3f>> poses,
                                          std::span<const uint32_t> places = {});

// Turns these triangles.
void turn_triangles(std::span<const uint32_t> triangles, Topology& topology);

}  // namespace paim
