// The albedo of a mesh from the colours of its OBJ file.
#pragma once

#include <string>
#include <vector>

#include "compressor/io/obj_parse.h"
#include "compressor/io/polygons.h"
#include "paim/mesh/topology.h"

namespace paim {

// The albedo is the colours of the vertices, if all that a face has have one; else the Kd of
// materials, averaged over the faces at each vertex (each face counts once, whatever its area; a face without Kd has
// the default albedo); else the default albedo. It is one value if all faces have the same. Values
// are linear; Kd is taken as linear.
// srgb      whether the colours of vertices are to be converted from sRGB, after clamping
// warnings  gets a line if values were clamped to [0, 1], and one about textures, which are not
//           read
Albedo obj_albedo(const std::string& name, const Polygons& faces, const ParsedObj& parsed,
                  bool srgb, std::vector<std::string>& warnings);

}  // namespace paim
