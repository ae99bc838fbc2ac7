// Bit rates of files.
#include "paim/metrics/rates.h"

#include <limits>

namespace paim {

double bits_per_vertex_per_pose(uint64_t num_bytes, uint64_t num_vertices, uint64_t num_poses) {
    if (num_vertices == 0 || num_poses == 0) return std::numeric_limits<double>::quiet_NaN();
    return 8.0 * static_cast<double>(num_bytes) / static_cast<double>(num_vertices) /
           static_cast<double>(num_poses);
}

}  // namespace paim
