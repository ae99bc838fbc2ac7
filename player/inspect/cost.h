// Bytes and arithmetic that a frame needs, for panels and --json.
#pragma once

#include <cstdint>

#include "paim/codec/asset.h"
#include "paim/codec/decode_limits.h"

namespace paim::player {

struct Cost {
    // Of everything in use, in its stored precision, before the file packs it.
    uint64_t bytes;
    // Per vertex and frame, positions and transfer under coloured light (codec/frame_cost.h).
    uint64_t multiply_adds;
    // Per frame in addition to these, on the CPU: rebuilding and lighting bases that vertices
    // share.
    uint64_t cpu_multiply_adds;
    uint32_t geometry_components;  // in use
    uint32_t transfer_components;
    uint32_t vertex_components;
    uint32_t bands;
};

Cost frame_cost(const CodedMesh& mesh, const DecodeLimits& limits);

}  // namespace paim::player
