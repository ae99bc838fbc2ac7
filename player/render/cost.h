// What a frame needs of a model: bytes and arithmetic, for the overlay and --json.
#pragma once

#include <cstdint>

#include "paim/codec/decoder.h"
#include "paim/codec/model.h"

namespace paim::player {

struct Cost {
    uint64_t bytes;          // of means, components and weights in use, as stored in the file
    uint64_t multiply_adds;  // per vertex and frame: rebuilding position and transfer, shading
    uint32_t geometry_components;  // in use
    uint32_t transfer_components;
    uint32_t bands;
};

Cost frame_cost(const Model& model, const DecodeLimits& limits);

}  // namespace paim::player
