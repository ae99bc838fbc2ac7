// The albedo of a mesh from the colours of its OBJ file.
#pragma once

#include <string>
#include <vector>

#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_scan.h"
#include "paim/mesh/topology.h"

namespace paim {

// The albedo of a mesh is the colours of its vertices, if all that a face has have one; else the Kd
// of materials, averaged over the faces at each vertex (each face counts once, whatever its area; a
// face without Kd has the default albedo); else the default albedo. It is one value if all faces have
// the same. Values are linear; Kd is taken as linear.

// colours   [V] of the vertices, as written
// srgb      whether they are to be converted from sRGB, after clamping
// warnings  gets a line if values were clamped to [0, 1]
Albedo albedo_of_colours(const std::string& name, const std::vector<Vec3d>& colours, bool srgb,
                         std::vector<std::string>& warnings);

// scan       with materials
// libraries  those of the scan
// warnings   gets a line if values were clamped to [0, 1], and one about textures, which are not
//            read
Albedo albedo_of_materials(const std::string& name, const ObjScan& scan,
                           const ObjLibraries& libraries, std::vector<std::string>& warnings);

}  // namespace paim
