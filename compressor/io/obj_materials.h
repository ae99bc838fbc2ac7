// The diffuse and the glossy part of .mtl material libraries.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_texture_map.h"
#include "paim/base/vector.h"

namespace paim {

// Numbers are as written: finite, and perhaps out of range.
struct ObjMaterial {
    std::string name;
    std::optional<Vec3d> diffuse;        // Kd
    double diffuse_share = 1.0;          // of Kd and of the image: less for metals (obj_gloss.h)
    std::optional<ObjTextureMap> map;    // map_Kd
    std::filesystem::path folder;        // of the library, to which names of images are relative
    std::optional<Vec3d> specular;       // Ks
    std::optional<double> exponent;      // Ns
    std::optional<double> illumination;  // illum: the number of a lighting model
    std::optional<double> roughness;     // Pr, of the PBR extension
    std::optional<double> metallic;      // Pm, of the PBR extension
};

// name      of the library, for messages
// text      of the library; rewritten in place where it has comments
// warnings  gets a line for every colour that is none, such as a spectral curve, and for every
//           number that is none; such lines are ignored. Of lines with the same keyword the last
//           counts
// gloss     false: Ks, Ns, illum, Pr and Pm give no warnings
std::vector<ObjMaterial> parse_obj_materials(const std::string& name, std::span<char> text,
                                             bool gloss, std::vector<std::string>& warnings);

}  // namespace paim
