// What is odd about a mesh: counted, so that nobody is surprised by its light. What the bake does
// about each is in docs/geometry.md.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/topology.h"

namespace paim {

// Known from the faces alone. Edges are those of faces with three different vertices, duplicates
// left out.
struct TopologyReport {
    uint64_t isolated_vertices = 0;  // in no face
    uint64_t duplicate_faces = 0;    // an earlier face has the same vertices and faces the same way
    uint64_t back_faces = 0;      // an earlier face has the same vertices and faces the other way
    uint64_t boundary_edges = 0;  // of one face
    uint64_t flipped_edges = 0;   // of two faces that run along them in the same direction
    uint64_t non_manifold_edges = 0;  // of three or more faces
};

TopologyReport report_topology(const Topology& topology);

// Different in every pose.
struct PoseReport {
    uint64_t zero_area_faces = 0;
    // Faces with area whose corners lie exactly where those of an earlier one do, in any order,
    // without being its vertices.
    uint64_t coincident_faces = 0;
};

// positions [V] finite
PoseReport report_pose(const Topology& topology, std::span<const Vec3f> positions);

// The topology without the faces that have the same three vertices as an earlier one. Vertex
// normals are computed from these: a face that is there twice is no larger, and has the side of the
// first.
Topology without_duplicate_faces(const Topology& topology);

}  // namespace paim
