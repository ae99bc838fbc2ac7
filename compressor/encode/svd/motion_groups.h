// Groups of vertices that move together: the bodies of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "compressor/encode/data/row_source.h"
#include "paim/mesh/topology.h"

namespace paim {

// A group for each connected piece that has a twentieth of all vertices with faces or more, such as a
// floor. Smaller pieces are in one group if they move together, such as the parts of a robot: the
// distance between the centres of two of them changes by no more than the larger one is large (RMS over
// the poses; a piece is twice as large as its vertices are from its centre, RMS), or others link
// them. So the walkers of a crowd are groups of their own. Of small pieces, the 256 that have the most
// vertices are compared; all others are one group, number 0.
// rows     planes x, y and z of V rows each; read once if there is more than one small piece
// returns  [V] numbers of groups, from 0 without gaps but for 0
std::vector<uint32_t> motion_groups(const Topology& topology, const RowSource& rows);

// Memory of motion_groups() for V vertices and P poses, without blocks of rows.
uint64_t motion_groups_bytes(uint64_t num_vertices, uint64_t num_poses);

}  // namespace paim
