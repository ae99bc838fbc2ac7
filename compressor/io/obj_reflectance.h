// Materials that reflect more light than arrives.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_gloss.h"
#include "compressor/io/obj_libraries.h"
#include "compressor/io/obj_scan.h"
#include "paim/mesh/topology.h"

namespace paim {

// A warning for each glossy material whose diffuse and glossy reflection of light along the normal are
// more than all of it in a channel; at most 8, and one that counts the others. At grazing angles any
// surface reflects almost all light (Fresnel), so that they would not tell materials apart.
// name     of the OBJ file
// colours  [faces of the scan] diffuse; empty: those of the albedo, the largest of each face
std::vector<std::string> reflectance_warnings(const std::string& name, const ObjScan& scan,
                                              const ObjLibraries& libraries,
                                              const FoundGloss& gloss,
                                              std::span<const Vec3d> colours, const Albedo& albedo);

}  // namespace paim
