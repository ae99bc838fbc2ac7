// The albedo of a mesh from the colours of its OBJ file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_scan.h"
#include "paim/mesh/topology.h"

namespace paim {

// The albedo of a mesh is the colours of its vertices, if all that a face has have one; else the
// colours of its faces, averaged over the faces at each vertex (each face counts once, whatever its
// area); else the default albedo. It is one value if all faces have the same. The colour of a face
// is the Kd of its material, or the default albedo without one, or the average of an image
// (obj_texture.h). Values are linear; Kd is taken as linear.

// colours   [V] of the vertices, as written
// srgb      whether they are to be converted from sRGB, after clamping
// warnings  gets a line if values were clamped to [0, 1]
Albedo albedo_of_colours(const std::string& name, const std::vector<Vec3d>& colours, bool srgb,
                         std::vector<std::string>& warnings);

// scan       with materials
// libraries  those of the scan
// warnings   gets a line if values were clamped to [0, 1]
// returns    [faces of the scan], or nothing if the libraries have no material
std::vector<Vec3d> colours_of_faces(const std::string& name, const ObjScan& scan,
                                    const ObjLibraries& libraries,
                                    std::vector<std::string>& warnings);

// colours  [faces of the scan], or nothing: the default albedo
Albedo albedo_of_faces(const ObjScan& scan, std::span<const Vec3d> colours);

}  // namespace paim
