// Measures a .paim against its bake and states the errors in it.
#pragma once

#include <cstdint>
#include <filesystem>

#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// Measures the file against the bake that it was made from and rewrites it, all or nothing, with
// the errors in its provenance ("measured"). Holds the whole model in memory.
// Errors: unsupported as check_measuring_memory() (the file stays as it is); output failed.
AssetError state_errors(const std::filesystem::path& file, const BakeReader& bake,
                        const BandPower& spectrum, uint64_t memory_bytes);

}  // namespace paim
