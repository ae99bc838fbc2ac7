// What a file costs to keep and to play: bits and multiply-adds.
// Based on: Sloan, Hall, Hart and Snyder, Clustered Principal Components for Precomputed Radiance
//           Transfer, 2003 (the order in which light and weights are multiplied)
#pragma once

#include <cstdint>

#include "paim/transfer/layout.h"

namespace paim {

// Bits per vertex and pose ("bpvf") of so many bytes; 0 of no vertices or poses.
double bits_per_vertex_per_pose(uint64_t num_bytes, uint64_t num_vertices, uint64_t num_poses);

// Multiply-adds of one frame. A mean counts as a component of weight 1.
struct FrameCost {
    uint64_t decode_per_vertex = 0;
    uint64_t light_per_vertex = 0;  // after decoding
    uint64_t cpu_per_frame = 0;     // once for all vertices

    uint64_t per_vertex() const { return decode_per_vertex + light_per_vertex; }
};

// Products of light that a vertex needs: 1 under grey light if it is grey itself, otherwise 3.
uint32_t num_radiance_channels(const TransferLayout& layout, bool coloured_light);

// Codec svd, positions: mean and components of three coordinates.
FrameCost svd_geometry_cost(uint32_t num_components);

// Codec svd, transfer: weights first, then light. A vertex rebuilds all its coefficients, (K + 1)
// multiply-adds each, and only then meets the light.
FrameCost svd_transfer_cost(const TransferLayout& layout, uint32_t num_components,
                            bool coloured_light);

// Codec cpca, transfer: light first. Each cluster's mean and K components are multiplied by the light
// once a frame; a vertex has K + 1 multiply-adds a channel left, light included.
// num_time_components  of which the clusters' bases are weighted sums in every pose; 0: kept as they
//                      are
FrameCost clustered_transfer_cost(const TransferLayout& layout, uint32_t num_clusters,
                                  uint32_t num_components, uint32_t num_time_components,
                                  bool coloured_light);

}  // namespace paim
