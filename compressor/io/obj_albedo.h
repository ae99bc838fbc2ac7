// The albedo of a mesh from what its OBJ file says about colour.
#pragma once

#include <string>
#include <vector>

#include "compressor/io/obj_parse.h"
#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

// The first that there is: a colour at every vertex; Kd of materials, averaged over the faces round
// each vertex (a face counts once, whatever its area; faces without a Kd count with the default
// albedo); the default albedo. One value where all faces agree. Values are linear.
// warnings  gets a line if values had to be clamped to [0, 1], and one about textures, which are
// not
//           read
Albedo obj_albedo(const std::string& name, const Polygons& faces, const ParsedObj& parsed,
                  std::vector<std::string>& warnings);

}  // namespace paim
