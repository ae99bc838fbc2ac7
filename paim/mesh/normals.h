// Vertex normals from faces.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Unit normal of the triangle a b c, computed in double. Zero if the triangle has no area: two
// corners are equal, or all lie on one line (up to the rounding of products).
Vec3d face_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c);

// The normalised average of the unit normals of the faces round each vertex (eq. 14 of Cardoso and
// Kry 2012).
// positions  [V] scene units, finite
// returns    [V] unit normals; zero where a vertex has no face of any area, or its faces cancel out
// note       faces without area do not count; duplicate faces count twice, so remove them first
//            (without_duplicate_faces() in mesh_report.h)
std::vector<Vec3f> vertex_normals(const Topology& topology, std::span<const Vec3f> positions);

}  // namespace paim
