// Reads files that were made from a bake, or from the glossy transfer of one.
#pragma once

#include <filesystem>

#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// The asset of a file whose transfer is that of the bake. Of a bake of glossy transfer alone
// (BakeReader::gloss), that is the gloss of the file, or its transfer if the file has that kind alone.
// Errors: those of read_paim(); bad input if the file has no gloss.
Asset read_file_of(const BakeReader& bake, const std::filesystem::path& path);

}  // namespace paim
