// Counts properties of a mesh that make its light surprising, such as flipped faces.
// docs/geometry.md says how the bake treats each.
#pragma once

#include <cstdint>
#include <span>

#include "paim/mesh/topology.h"

namespace paim {

// Counts that depend on the faces alone. Edges are those of faces with three different vertices,
// without duplicate faces.
struct TopologyReport {
    uint64_t isolated_vertices = 0;  // in no face
    uint64_t duplicate_faces = 0;    // an earlier face has the same vertices and faces the same way
    uint64_t back_faces = 0;      // an earlier face has the same vertices and faces the other way
    uint64_t boundary_edges = 0;  // of one face
    uint64_t flipped_edges = 0;   // of two faces that run along them in the same direction
    uint64_t non_manifold_edges = 0;  // of three or more faces
};

TopologyReport report_topology(const Topology& topology);

// Counts that differ from pose to pose.
struct PoseReport {
    uint64_t zero_area_faces = 0;
    // Faces with area whose corners lie exactly at those of an earlier face, in any order, but are
    // other vertices.
    uint64_t coincident_faces = 0;
};

// positions [V] finite
PoseReport report_pose(const Topology& topology, std::span<const Vec3f> positions);

// The topology without faces that have the same three vertices as an earlier one. Vertex normals
// are computed from it, so that a duplicate face counts once, with the orientation of its first
// copy.
Topology without_duplicate_faces(const Topology& topology);

}  // namespace paim
