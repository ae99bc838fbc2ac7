// Encodes a bake into memory, by the encoder and the file format of the tools.
#pragma once

#include <filesystem>

#include "compressor/encode/options.h"
#include "paim/codec/asset.h"
#include "paim/format/bake/bake_directory.h"

namespace paim {

// options    without a limit of memory: afterwards the whole file is in memory, which takes far more
// directory  for a temporary file, which is removed
// Errors: those of encode().
Asset encode_in_memory(const BakeReader& bake, EncodeOptions options,
                       const std::filesystem::path& directory);

}  // namespace paim
