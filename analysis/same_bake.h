// Whether a .paim was made from a bake.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// One thing that the file says of the bake that it was made from, and what this bake has instead.
// Empty where there is none.
struct BakeDifference {
    // As in the provenance (docs/format.md), or "gloss": how many vertices of the poses are glossy.
    std::string name;
    std::string of_file, of_bake;
};

// None if the file says nothing of its bake, or was made from this one. The mesh is not compared.
std::vector<BakeDifference> bake_differences(const Asset& asset, const BakeReader& bake);

// A note on stderr if the file was made from another bake of this mesh, which says in what.
// tool  in front of the note; or empty
void say_if_of_another_bake(const std::string& tool, const std::filesystem::path& file,
                            const Asset& asset, const BakeReader& bake);

}  // namespace paim
