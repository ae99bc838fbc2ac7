// Vertex normals from faces.
// Based on: Thürmer and Wüthrich, Computing Vertex Normals from Polygonal Facets, 1998
#pragma once

#include <array>
#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// Unit normal of the triangle a b c, computed in double. Zero if the triangle has no area: two
// corners are equal, or all lie on one line (up to the rounding of products).
Vec3d face_normal(const Vec3f& a, const Vec3f& b, const Vec3f& c);

// The angles of the triangle at a, b and c, 0 … π each, to a few roundings of double at any size.
// Angles at an edge without length mean nothing.
std::array<double, 3> corner_angles(const Vec3f& a, const Vec3f& b, const Vec3f& c);

// The normalised sum of the unit normals of the faces round each vertex, each times the angle of
// the face at the vertex. The angles of the triangles of a planar polygon add up to its own, so that
// normals do not depend on how it was cut.
// positions  [V] scene units, finite
// seams      [V] the vertex with which each shares its normal (mesh/seams.h): their faces count as
//            those of one vertex. Empty: no two vertices share one
// returns    [V] unit normals; zero where a vertex has no face of any area, or its faces cancel out
// note       faces without area do not count; duplicate faces count twice, so remove them first
//            (without_duplicate_faces() in mesh_report.h)
std::vector<Vec3f> vertex_normals(const Topology& topology, std::span<const Vec3f> positions,
                                  std::span<const uint32_t> seams = {});

}  // namespace paim
