// What a file costs to keep and to play: bits and multiply-adds.
// Based on: Sloan, Hall, Hart and Snyder 2003 (see the header)
#include "paim/metrics/rates.h"

namespace paim {

double bits_per_vertex_per_pose(uint64_t num_bytes, uint64_t num_vertices, uint64_t num_poses) {
    if (num_vertices == 0 || num_poses == 0) return 0.0;
    return 8.0 * static_cast<double>(num_bytes) / static_cast<double>(num_vertices) /
           static_cast<double>(num_poses);
}

uint32_t num_radiance_channels(const TransferLayout& layout, bool coloured_light) {
    return coloured_light || layout.channels > 1 ? 3 : 1;
}

FrameCost svd_geometry_cost(uint32_t num_components) {
    return {3 * (uint64_t{num_components} + 1), 0, 0};
}

FrameCost svd_transfer_cost(const TransferLayout& layout, uint32_t num_components,
                            bool coloured_light) {
    const uint64_t channels = num_radiance_channels(layout, coloured_light);
    return {(uint64_t{num_components} + 1) * layout.num_planes(),
            channels * layout.num_coefficients(), 0};
}

FrameCost clustered_transfer_cost(const TransferLayout& layout, uint32_t num_clusters,
                                  uint32_t num_components, uint32_t num_time_components,
                                  bool coloured_light) {
    const uint64_t channels = num_radiance_channels(layout, coloured_light);
    const uint64_t functions = uint64_t{num_clusters} * (uint64_t{num_components} + 1);
    return {channels * (uint64_t{num_components} + 1), 0,
            functions * (channels * layout.num_coefficients() +
                         uint64_t{num_time_components} * layout.num_planes())};
}

}  // namespace paim
