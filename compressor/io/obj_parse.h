// Normals of scanned OBJ text, by tinyobjloader.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_scan.h"
#include "paim/base/vector.h"

namespace paim {

struct ParsedObj {
    std::vector<Vec3d> normals;           // vn lines as written
    std::vector<int32_t> corner_normals;  // per corner: index into normals, or -1
};

// It takes ten times as long as the scan, which gives all else of a file.
// text  as rewritten by scan_obj(), which returned `scan`
// Errors (bad input): tinyobjloader refuses the file, or finds other faces than the scan.
ParsedObj parse_obj(const std::string& name, std::span<char> text, const ObjScan& scan);

}  // namespace paim
