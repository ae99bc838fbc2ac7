// Bit rates of files.
#pragma once

#include <cstdint>

namespace paim {

// Bits per vertex and pose ("bpvf"); not a number without vertices or poses.
double bits_per_vertex_per_pose(uint64_t num_bytes, uint64_t num_vertices, uint64_t num_poses);

}  // namespace paim
