// Seams: where a surface is cut into patches whose vertices lie at the same places.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// [V] The lowest vertex with which each shares its normal; empty if all vertices have one of their
// own. Exporters double vertices where texture coordinates (or normals) of faces differ. Such
// vertices lie at the same place in every pose, and the surface goes on across the edges there.
// Two edges with the same ends (by place) are a seam if
//
// * each is the edge of one face by its vertices, and no third such edge has these ends;
// * they run in opposite directions, as those of neighbours that face the same side do;
// * their faces do not lie back to back in the first pose, as the two sides of a card do. Faces with
//   an outlier there do not say.
//
// The vertices at both ends of such edges share normals. Surfaces that only touch, also those that
// touch in every pose, have no such edges unless both are open there.
// topology    without duplicate faces (mesh_report.h)
// places      [V] the vertices with which each shares its place in every pose (sequence_places.h), or
//             empty
// first_pose  [V] positions
// longest_edge  longer edges of the first pose have an outlier at one end
std::vector<uint32_t> find_seams(const Topology& topology, std::span<const uint32_t> places,
                                 std::span<const Vec3f> first_pose,
                                 double longest_edge = std::numeric_limits<double>::infinity());

}  // namespace paim
