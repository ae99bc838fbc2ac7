// Finds the material libraries that mtllib lines name, and the materials that usemtl lines name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "compressor/io/obj_materials.h"
#include "compressor/io/obj_scan.h"

namespace paim {

struct ObjLibraries {
    std::vector<ObjMaterial> materials;  // of all libraries
    std::vector<int32_t> of_name;        // per name of the scan: index into materials, or -1
    std::vector<std::string> warnings;
};

// Reads the libraries of all mtllib lines, 4 MiB at most together.
//
// A line may name several libraries with spaces between, and a name may have spaces. So from each
// word on the longest name is taken that is a file. A name is looked for as it is written, without
// quotes round it, and with each '\' as '/'. Names of files that are not there end with a word that
// ends in .mtl. Of these the only file is taken whose path differs in case only (of the letters
// A to Z), with a warning; at last, what follows the last '/' or '\' is looked for next to the OBJ
// file, as written or in other case.
//
// A material has all of the line as its name, without space at either end. A usemtl line that no
// name equals is compared without quotes and with each run of space as one, and then one of the two
// names without what follows a '#' after a space. Of materials with the same name the first counts.
// name    of the OBJ file, for messages
// folder  of the OBJ file; its names are relative to it
// scan    with materials
// Unreadable libraries and unknown materials give warnings.
ObjLibraries read_obj_libraries(const std::string& name, const std::filesystem::path& folder,
                                const ObjScan& scan);

}  // namespace paim
