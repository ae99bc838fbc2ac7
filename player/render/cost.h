// What a frame needs of a model: bytes and arithmetic, for the overlay and --json.
#pragma once

#include <cstdint>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim::player {

struct Cost {
    // Of means, components, weights, clusters and coefficients in use, as their precision is, before
    // the file packs them.
    uint64_t bytes;
    // Per vertex and frame. Position: 3 (Kg + 1). Vertices with transfer of their own rebuild it,
    // (Kt + 1) C a channel, and shade, 3 C. Clustered ones do both in 3 (K + 1), K components of a
    // cluster. Means count as components whose weight is 1.
    uint64_t multiply_adds;
    // Per frame beside these: rebuilding and lighting the bases of clusters, on the CPU.
    uint64_t cluster_multiply_adds;
    uint32_t geometry_components;  // in use
    uint32_t transfer_components;
    uint32_t cluster_components;
    uint32_t bands;
};

Cost frame_cost(const Model& model, const DecodeLimits& limits);

}  // namespace paim::player
