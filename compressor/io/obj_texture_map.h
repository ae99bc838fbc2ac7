// What a map_Kd line says: an image, and how it lies on the surface.
// Based on: Alias Wavefront, The MTL file format, 1995
#pragma once

#include <string>
#include <string_view>

#include "paim/base/vector.h"

namespace paim {

struct ObjTextureMap {
    std::string file;  // as written; empty if the line names none
    // The image is looked up at coordinate · scale + offset (-s and -o).
    Vec2f scale = Vec2f::Ones();
    Vec2f offset = Vec2f::Zero();
    std::string ignored;  // an option of the line that changes the picture and is not read; or ""
};

// text  what follows the keyword: options, each with its arguments, and the rest is the name of a
//       file, which may have spaces
// Options that only say how an image is filtered (-blendu, -blendv, -boost, -texres), or that are
// for other maps (-bm, -imfchan), and those that say what is done anyway (-clamp off), are skipped.
ObjTextureMap parse_texture_map(std::string_view text);

}  // namespace paim
