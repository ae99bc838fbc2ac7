// How much memory it takes to measure a file after it was written.
#pragma once

#include <cstdint>
#include <string>

#include "compressor/encode/memory/memory_plan.h"
#include "paim/transfer/layout.h"

namespace paim {

// Peak memory of the process while it measures a file of floats of this size.
// still_mesh_bytes  of the still mesh in the bake
uint64_t measuring_memory_bytes(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                                uint64_t still_mesh_bytes);

// Error (unsupported), naming `what` and the memory that is needed, if limit_bytes are too few.
void check_measuring_memory(uint64_t file_bytes, uint64_t num_vertices, uint64_t num_poses,
                            uint64_t still_mesh_bytes, uint64_t limit_bytes,
                            const std::string& what);

// The same for a bake that does not exist yet. Components count if they are asked for by number or
// all; the number that `auto` will take and the rank of the geometry are not known, and count as 0.
void check_measuring_memory(const EncodeSize& bake, const TransferLayout& layout,
                            const EncodeOptions& options, const std::string& what);

}  // namespace paim
