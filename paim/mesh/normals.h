// Vertex normals from faces.
// Based on: Cardoso and Kry, Error Analysis of Precomputed Radiance Transfer for Deforming
// Geometry, 2012
#pragma once

#include <span>
#include <vector>

#include "paim/mesh/topology.h"

namespace paim {

// The normalised average of the unit normals of the faces round each vertex (E14 of the paper).
// positions  [V] scene units, finite
// returns    [V] unit normals; zero where a vertex has no face of any area, or its faces cancel out
// note       zero-area faces have no normal and do not count
std::vector<Vec3f> vertex_normals(const Topology& topology, std::span<const Vec3f> positions);

}  // namespace paim
