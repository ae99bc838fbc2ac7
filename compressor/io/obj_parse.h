// Parses scanned OBJ text, and its material libraries, by tinyobjloader.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "compressor/io/obj_materials.h"
#include "compressor/io/obj_scan.h"
#include "paim/base/vector.h"

namespace paim {

struct ParsedObj {
    std::vector<Vec3d> positions;  // [V] scene units, those of the scan
    // [V] r g b as written, or empty unless all vertices of faces have one; others may be white.
    std::vector<Vec3d> colors;
    std::vector<Vec3d> normals;           // vn lines as written
    std::vector<int32_t> corner_normals;  // per corner: index into normals, or -1
    std::vector<int32_t> face_materials;  // per face: index into materials, or -1
    std::vector<ObjMaterial> materials;
    std::vector<std::string> warnings;  // each once; about materials
};

// text  as rewritten by scan_obj(), which returned `scan` with positions. Those of tinyobjloader
//       are not used, because they may be wrong by some roundings.
// folder  of the file. The material libraries of a scan with materials are relative to it.
// Unreadable material libraries give warnings. Errors (bad input): tinyobjloader refuses the file,
// or finds other faces than the scan.
ParsedObj parse_obj(const std::string& name, std::span<char> text, const ObjScan& scan,
                    const std::filesystem::path& folder = {});

}  // namespace paim
