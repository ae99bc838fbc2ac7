// Makes a .paim say how far it is from its bake.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "compressor/encode/memory/memory_plan.h"
#include "paim/format/bake/bake_directory.h"
#include "paim/metrics/asset_error.h"

namespace paim {

// Peak memory of the process while it measures a file of floats of this size.
// scenery_bytes  as it was baked
uint64_t measuring_memory_bytes(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                                uint64_t scenery_bytes);

// Error (unsupported) naming `what` and the memory that is needed, if it is more than limit_bytes.
void check_measuring_memory(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                            uint64_t scenery_bytes, uint64_t limit_bytes, const std::string& what);

// The same of a bake that is not there yet, by the components that are asked for by number or all: how
// many `auto` will take is not known, nor what rank the geometry has.
void check_measuring_memory(const EncodeSize& bake, const TransferLayout& layout,
                            const EncodeOptions& options, const std::string& what);

// Measures the file against the bake that it was just made from and rewrites it, all or nothing, with
// the errors in its provenance ("measured"). The whole model is in memory meanwhile.
// Errors: unsupported as check_measuring_memory() (the file stays as it is); output failed.
AssetError state_errors(const std::filesystem::path& file, const BakeReader& bake,
                        const BandPower& spectrum, uint64_t memory_bytes);

}  // namespace paim
