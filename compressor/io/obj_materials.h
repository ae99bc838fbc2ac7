// The diffuse part of .mtl material libraries.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "paim/base/vector.h"

namespace paim {

struct ObjMaterial {
    std::string name;
    std::optional<Vec3d> diffuse;  // Kd as written, finite; may be out of [0, 1]
    std::string diffuse_texture;   // map_Kd, empty if none
};

// name      of the library, for messages
// text      of the library; rewritten in place where it has comments
// warnings  gets a line for every Kd that is not a colour, such as a spectral curve; such a Kd is
//           ignored
std::vector<ObjMaterial> parse_obj_materials(const std::string& name, std::span<char> text,
                                             std::vector<std::string>& warnings);

}  // namespace paim
