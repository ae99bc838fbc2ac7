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

// Removes repeated warnings, and shortens a long list to 8 and the number of the others.
// name  of the OBJ file
void shorten_warnings(const std::string& name, std::vector<std::string>& warnings);

// The material of a name of the scan (an index, or -1), or nullptr.
inline const ObjMaterial* material_of_name(const ObjLibraries& libraries, int32_t named) {
    const int32_t material = named >= 0 && !libraries.of_name.empty()
                                 ? libraries.of_name[static_cast<size_t>(named)]
                                 : -1;
    return material >= 0 ? &libraries.materials[static_cast<size_t>(material)] : nullptr;
}

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
// gloss   whether the glossy part of materials will be used; if not, oddities of it give no warnings
// Unreadable libraries and unknown materials give warnings.
ObjLibraries read_obj_libraries(const std::string& name, const std::filesystem::path& folder,
                                const ObjScan& scan, bool gloss = false);

}  // namespace paim
