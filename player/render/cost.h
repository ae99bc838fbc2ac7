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
    // Per vertex and frame, positions and transfer under coloured light (metrics/rates.h).
    uint64_t multiply_adds;
    // Per frame, in addition: rebuilding and lighting the bases of clusters on the CPU.
    uint64_t cluster_multiply_adds;
    uint32_t geometry_components;  // in use
    uint32_t transfer_components;
    uint32_t cluster_components;
    uint32_t bands;
};

Cost frame_cost(const Model& model, const DecodeLimits& limits);

}  // namespace paim::player
