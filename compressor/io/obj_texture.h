// Images on the faces of a mesh, as the map_Kd lines of its material libraries say.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_scan.h"
#include "paim/mesh/texture.h"
#include "paim/mesh/topology.h"

namespace paim {

// A face has an image if its material has one and each of its corners has a texture coordinate.
// A file is kept once for each Kd of the materials that have it; a
// Kd of 0 0 0, which would hide the image, counts as 1 1 1, and so does none.
// name      of the OBJ file, for messages
// scan      with materials and coordinates
// topology  as it is baked: corners of a face are found by their vertices, so that turned triangles
//           keep theirs. Where a polygon has a vertex twice, its first corner counts
// polygons  [F] the face of the scan that each triangle is of
// colours   [faces of the scan] of faces with an image gets the average within the face, times the
//           factor of the image: the mean over its triangles, by their areas in the image
// warnings  get a line for each image that is missing, damaged or neither PNG nor JPEG, whose faces
//           keep their Kd; and lines about what is not supported
// Error (unsupported): more than 65,535 images, or more bytes than kMaxImageBytes.
Texture read_texture(const std::string& name, const ObjScan& scan, const ObjLibraries& libraries,
                     const Topology& topology, std::span<const uint32_t> polygons,
                     std::span<Vec3d> colours, std::vector<std::string>& warnings);

}  // namespace paim
