// Groups of vertices that move together: the bodies of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/encode/data/row_source.h"
#include "paim/mesh/topology.h"

namespace paim {

// A group for each connected piece that has a twentieth of all vertices with faces or more, such as a
// floor. Smaller pieces are taken by their numbers of vertices, most first. Each that has no group yet
// begins one, and all pieces that move together with it join, such as the parts of a robot with its
// body: the distance between their centres changes by no more than the larger one of the two is large
// (RMS over the poses; a piece is twice as large as its vertices are from its centre, RMS). So the
// walkers of a crowd that walk apart are groups of their own. 256 small pieces are compared; all others
// are one group, number 0.
// rows     planes x, y and z of V rows each; read once if there is more than one small piece
// returns  [V] numbers of groups, from 0 without gaps but for 0
std::vector<uint32_t> motion_groups(const Topology& topology, const RowSource& rows);

// Memory of motion_groups() for V vertices and P poses, without blocks of rows.
uint64_t motion_groups_bytes(uint64_t num_vertices, uint64_t num_poses);

}  // namespace paim
