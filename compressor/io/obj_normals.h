// Vertex normals from the vn lines of an OBJ file.
#pragma once

#include <span>
#include <vector>

#include "compressor/io/obj_parse.h"
#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

// The normalised average of the unit vn of the corners at each vertex. A vn of length 0 does not
// count. If all are 0, or cancel, the vertex has the normal that mesh/normals.h computes from its
// triangles. It is zero for vertices without faces.
// positions  [V] scene units, from any origin
// returns    [V] unit or zero
std::vector<Vec3f> obj_normals(const Topology& topology, const Polygons& faces,
                               const ParsedObj& parsed, std::span<const Vec3f> positions);

}  // namespace paim
